// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Stages and parameters: one case a kind of mistake, with its code, its place, what it says and
// what it advises.
#include <catch2/catch.hpp>

#include "graph_support.hpp"

using velum::test::lines_of;
using velum::test::mistakes;
using Lines = std::vector<std::string>;

namespace {

const std::string kScan = "[node.scan]\nuse = \"devices.simulator\"\n";

/// Mistakes of a voxel grid with this line, the fourth after `head`.
Lines voxel(const std::string& line, const std::string& head = "\n") {
  return mistakes(head + kScan + "[node.down]\nuse = \"resampling.voxel_grid\"\nin = \"scan\"\n" +
                  line + "\n");
}

}  // namespace

TEST_CASE("a graph without mistakes") {
  const auto loaded = velum::test::load_text(kScan);
  CHECK(velum::graph::format(loaded.diagnostics).empty());
  CHECK(velum::graph::exit_status(loaded.diagnostics) == 0);
  REQUIRE(loaded.graph);
  REQUIRE(loaded.graph->nodes.size() == 1);
  CHECK(loaded.graph->nodes[0].name == "scan");
  CHECK(loaded.graph->nodes[0].where.begin == velum::graph::toml::Position{1, 7});
}

TEST_CASE("six mistakes in one graph") {
  const auto loaded = velum::test::load_text(R"(title = "six mistakes"
units = "mm"
[node.scan]
use = "io.read_cloud"
file = "does-not-exist.pcd"
[node.normals]
use = "features.normalz"
in = "scan"
[node.sail]
use = "segmentation.region_growing"
in = "scan"
smothness = "7 deg"
min_size = -5
[node.mesh]
use = "meshing.delaunay_projected"
in = "nowhere"
max_edge = "150 apples"
)");
  CHECK(velum::graph::exit_status(loaded.diagnostics) == 2);
  CHECK(
      lines_of(loaded.diagnostics) ==
      Lines{
          "E0501 5:8 node 'scan' (io.read_cloud): there is no file 'does-not-exist.pcd' | the name "
          "is relative to the graph's folder",
          "E0304 7:7 unknown stage 'features.normalz' in node 'normals' | did you mean "
          "'features.normals'? | known: features.broken, features.normals",
          "E0203 12:1 unknown parameter 'smothness' in node 'sail' (segmentation.region_growing) "
          "| did you mean 'smoothness'? | known: smoothness, curvature, min_size",
          "E0206 13:12 'min_size' of node 'sail' (segmentation.region_growing) is -5; it must be "
          "at least 1",
          "E0404 16:6 node 'mesh' (meshing.delaunay_projected) takes from 'nowhere', but there is "
          "no such node | known: normals, sail, scan",
          "E0205 17:12 'max_edge' of node 'mesh' (meshing.delaunay_projected): 'apples' is no "
          "unit of length | known: m, mm, cm, km, um, in, ft, spacing, diagonal, % spacing, "
          "% diagonal"});
  const std::string text = velum::graph::format(loaded.diagnostics);
  CHECK(text.find("error[E0203] g.toml:12:1  unknown parameter 'smothness'") != std::string::npos);
  CHECK(text.find("\n   12 |   smothness = \"7 deg\"\n"
                  "      |   ^^^^^^^^^ did you mean 'smoothness'?  (known: smoothness, curvature, "
                  "min_size)\n") != std::string::npos);
  CHECK(text.ends_with("6 mistakes\n"));
}

TEST_CASE("E0101: syntax") {
  CHECK(mistakes("title = \"a\nb = 1\n") ==
        Lines{"E0101 1:9 this string is not closed | it ends on its line"});
  CHECK(mistakes(kScan + "in = [\"a\",\n  \"b\"\n[node.next]\nuse = \"x\"\n") ==
        Lines{"E0101 3:6 this array is not closed | a ']' is missing before line 6"});
  CHECK(mistakes("a = 1\na = 2\n").at(0).starts_with("E0101 2:"));
  CHECK(mistakes("[\n[").at(0) == "E0101 1:2 a key is missing here");
}

TEST_CASE("E0105: no nodes") {
  const Lines none = {
      "E0105 0:0 the graph has no nodes | write [node.NAME] with use = "
      "\"KIND.NAME\""};
  CHECK(mistakes("") == none);
  CHECK(mistakes("title = \"nothing\"") == none);
  CHECK(velum::test::catalog().find("nothing") == nullptr);
}

TEST_CASE("E0106: format") {
  CHECK(mistakes("format = 1\n" + kScan).empty());
  CHECK(mistakes("format = 2\n" + kScan) ==
        Lines{"E0106 1:10 format 2 is not known | this version reads format = 1"});
}

TEST_CASE("E0107: more nodes than anyone writes") {
  std::string text;
  for (int i = 0; i < 10'002; ++i) text += "[node.n" + std::to_string(i) + "]\n";
  const Lines lines = mistakes(text);
  CHECK(std::count(lines.begin(), lines.end(), "E0107 10001:7 more than 10000 nodes") == 1);
}

TEST_CASE("E0201: unknown key at the top") {
  CHECK(
      mistakes("tilte = \"x\"\n" + kScan) ==
      Lines{"E0201 1:1 unknown key 'tilte' | did you mean 'title'? | known: format, title, units, "
            "include, node, study"});
}

TEST_CASE("E0203: unknown parameter") {
  CHECK(
      voxel("sise = \"5 mm\"") ==
      Lines{"E0207 4:7 node 'down' (resampling.voxel_grid) lacks the parameter 'size': edge length "
            "of a voxel | add size = a length such as \"5 mm\" or \"2 spacing\"",
            "E0203 7:1 unknown parameter 'sise' in node 'down' (resampling.voxel_grid) | did you "
            "mean 'size'? | known: size"});
  CHECK(
      voxel("size = \"5 mm\"\nisolat = true") ==
      Lines{"E0203 8:1 unknown parameter 'isolat' in node 'down' (resampling.voxel_grid) | did you "
            "mean 'isolate'? | known: size"});
  CHECK(voxel("size = \"5 mm\"\ncloud = \"scan\"") ==
        Lines{"E0203 8:1 unknown parameter 'cloud' in node 'down' (resampling.voxel_grid) | write "
              "in = { cloud = ... } | known: size"});
}

TEST_CASE("E0204: type") {
  CHECK(mistakes("title = 3\n" + kScan) ==
        Lines{"E0204 1:9 'title' is an integer; expected text in quotes | put it in quotes"});
  CHECK(mistakes("node = 3\n").at(0) ==
        "E0204 1:1 'node' must be a table of nodes | write [node.NAME] above the keys of each");
  CHECK(mistakes("node.scan = 3\n").at(0) ==
        "E0204 1:6 node 'scan' must be a table | write [node.scan] above its keys");
  CHECK(voxel("size = true") ==
        Lines{"E0204 7:8 'size' of node 'down' (resampling.voxel_grid) is a boolean; expected a "
              "length such as \"5 mm\" or \"2 spacing\""});
}

TEST_CASE("E0205: unit") {
  CHECK(voxel("size = 5") ==
        Lines{"E0205 7:8 'size' of node 'down' (resampling.voxel_grid): 5 has no unit | write \"5 "
              "mm\", or units = \"mm\" at the top of the file"});
  CHECK(voxel("size = 5", "units = \"mm\"\n").empty());
  CHECK(
      voxel("size = \"5 mmm\"") ==
      Lines{"E0205 7:8 'size' of node 'down' (resampling.voxel_grid): 'mmm' is no unit of length | "
            "did you mean 'mm'? | known: m, mm, cm, km, um, in, ft, spacing, diagonal, % spacing, "
            "% diagonal"});
  CHECK(mistakes("units = \"millimetre\"\n" + kScan).at(0).starts_with("E0208 1:9 'units' cannot"));
}

TEST_CASE("E0206: range") {
  CHECK(
      voxel("size = \"0 mm\"") ==
      Lines{"E0206 7:8 'size' of node 'down' (resampling.voxel_grid) is \"0 mm\"; it must be above "
            "0 m"});
  CHECK(voxel("size = \"-2 spacing\"").size() == 1);
  CHECK(voxel("size = nan", "units = \"m\"\n") ==
        Lines{"E0206 7:8 'size' of node 'down' (resampling.voxel_grid) is nan; it must be a finite "
              "number"});
}

TEST_CASE("E0206: an integer that a stage could not hold") {
  const auto grow = [](const std::string& size) {
    return mistakes(kScan + "[node.n]\nuse = \"features.normals\"\nin = \"scan\"\n[node.sail]\n" +
                    "use = \"segmentation.region_growing\"\nin = \"n\"\nmin_size = " + size + "\n");
  };
  CHECK(grow("2147483647").empty());
  REQUIRE(grow("4294967299").size() == 1);
  CHECK(grow("4294967299").front().find("must be between -2147483647 and 2147483647") !=
        std::string::npos);
}

TEST_CASE("E0208: choice") {
  CHECK(
      mistakes(kScan + "[node.other]\nuse = \"devices.simulator\"\n[node.icp]\nuse = "
                       "\"registration.icp\"\nin = { source = \"scan\", target = \"other\" }\n"
                       "metric = \"point_to_plan\"\n") ==
      Lines{"E0208 8:10 'metric' of node 'icp' (registration.icp) cannot be 'point_to_plan' | did "
            "you mean 'point_to_plane'? | known: point_to_point, point_to_plane"});
}

TEST_CASE("E0209: a parameter under its old and its new name") {
  CHECK(voxel("leaf = \"5 mm\"").empty());
  CHECK(voxel("size = \"5 mm\"\nleaf = \"5 mm\"") ==
        Lines{"E0209 8:1 'size' and 'leaf' are the same parameter of node 'down' "
              "(resampling.voxel_grid) | keep 'size'"});
}

TEST_CASE("E0211: settings that do not fit together, as the stage itself says") {
  const std::string normals = kScan + "[node.n]\nuse = \"features.normals\"\nin = \"scan\"\n";
  CHECK(mistakes(normals + "radius = \"5 mm\"\n").empty());
  CHECK(mistakes(normals + "neighbours = 9\nradius = \"5 mm\"\n") ==
        Lines{"E0211 7:1 node 'n' (features.normals): 'neighbours' and 'radius' are both given | "
              "keep one of them"});
  // A slip in a name hides nothing.
  const Lines both = mistakes(normals + "neighbours = 9\nradius = \"5 mm\"\nradiuss = 1\n");
  REQUIRE(both.size() == 2);
  CHECK(both[0].starts_with("E0211"));
  CHECK(both[1].starts_with("E0203"));
  // One mistake is enough: what is wrong alone is not tried with the others.
  CHECK(mistakes(normals + "neighbours = 9\nradius = \"-5 mm\"\n").front().starts_with("E0206"));
}

TEST_CASE("E0212: limits, and the other keys of a node") {
  CHECK(mistakes(kScan + "limits = { time = \"1 min\", memory = \"2 GB\" }\n") ==
        Lines{"E0212 3:1 limits hold for isolated nodes only | add isolate = true"});
  CHECK(
      mistakes(kScan + "isolate = true\nlimits = { tim = 1, memory = \"2 XB\", time = -1 }\n") ==
      Lines{
          "E0202 4:12 unknown key 'tim' of 'limits' | did you mean 'time'? | known: time, memory",
          "E0205 4:30 'limits.memory': 'XB' is no unit of memory | did you mean 'kB'? | known: B, "
          "kB, MB, GB, KiB, MiB, GiB",
          "E0206 4:45 'limits.time' is -1; it must be above 0 s"});
  CHECK(mistakes(kScan + "cache = \"no\"\nseed = -1\n") ==
        Lines{"E0204 3:9 'cache' is a string; expected true or false",
              "E0206 4:8 'seed' is -1; it must be at least 0"});
  const auto loaded = velum::test::load_text(
      kScan +
      "isolate = true\nlimits = { time = \"1 min\", memory = \"2 GB\" }\nseed = 7\n"
      "title = \"Scan\"\ncache = false\nallow_empty = true\n");
  REQUIRE(loaded.graph);
  const auto& node = loaded.graph->nodes[0];
  CHECK(node.limits == velum::graph::Limits{60.0, 2'000'000'000U});
  CHECK(node.seed == 7U);
  CHECK(node.title == "Scan");
  CHECK((node.isolate && node.allow_empty && !node.cache));
}

TEST_CASE("E0301: names of nodes") {
  CHECK(
      mistakes("[node.total]\nuse = \"devices.simulator\"\n") ==
      Lines{"E0301 1:7 no node can be called 'total' | measures of the whole run have that name"});
  CHECK(mistakes("[node.\"a.b\"]\nuse = \"devices.simulator\"\n") ==
        Lines{"E0301 1:7 'a.b' is no name of a node | names are of letters, digits, '_' and '-'"});
}

TEST_CASE("E0303 to E0306: stages") {
  CHECK(
      mistakes("[node.a]\n") ==
      Lines{"E0303 1:7 node 'a' says no stage | add use = \"KIND.NAME\"; `velum list` shows them"});
  CHECK(mistakes("[node.a]\nuse = \"voxel_grid\"\n")
            .at(0)
            .starts_with("E0304 2:7 unknown stage 'voxel_grid' in node 'a' | did you mean "
                         "'resampling.voxel_grid'? | "
                         "known: analysis.*, devices.*"));
  CHECK(
      mistakes("[node.a]\nuse = \"graph:other.toml\"\n") ==
      Lines{"E0306 2:7 graphs within graphs are reserved for a later version | merge the nodes of "
            "the other file: include = \"other.toml\""});

  const auto broken = velum::test::load_text("[node.a]\nuse = \"features.broken\"\n");
  CHECK(lines_of(broken.diagnostics) ==
        Lines{"E0305 2:7 the plugin of 'features.broken' cannot be loaded: its Eigen version is "
              "30300, that of velum 30400"});
  CHECK(velum::graph::exit_status(broken.diagnostics) == 4);
  const auto both = velum::test::load_text("tilte = 1\n[node.a]\nuse = \"features.broken\"\n");
  CHECK(velum::graph::exit_status(both.diagnostics) == 2);
}
