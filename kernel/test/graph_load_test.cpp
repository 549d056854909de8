// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Files: the graph's own, those it includes, those it reads and writes; overrides.
#include <catch2/catch.hpp>

#include <sys/stat.h>

#include "graph_support.hpp"

using velum::test::Folder;
using velum::test::lines_of;
using Lines = std::vector<std::string>;
namespace fs = std::filesystem;

namespace {

const std::string kScan = "[node.scan]\nuse = \"devices.simulator\"\n";

velum::graph::Loaded load(const fs::path& path, const Lines& overrides = {},
                          const std::optional<fs::path>& out = {}) {
  return velum::graph::load(path, overrides, velum::test::catalog(), {out});
}

std::string message(const velum::graph::Loaded& loaded) {
  return velum::graph::format(loaded.diagnostics);
}

Lines write(const std::string& file, const std::optional<fs::path>& out = {}) {
  const std::string text =
      kScan + "[node.w]\nuse = \"io.write_cloud\"\nin = \"scan\"\nfile = \"" + file + "\"\n";
  return lines_of(
      velum::graph::load_text(text, "g.toml", {}, velum::test::catalog(), {out}).diagnostics);
}

}  // namespace

TEST_CASE("E0102: the graph cannot be read") {
  const Folder folder;
  const auto missing = load(folder.path() / "none.toml");
  REQUIRE(missing.diagnostics.size() == 1);
  CHECK(missing.diagnostics[0].code == "E0102");
  CHECK(message(missing) == "error[E0102] " + (folder.path() / "none.toml").string() +
                                "  cannot be read: No such file or directory\n");
  CHECK(load(folder.path()).diagnostics.at(0).code == "E0102");
  const auto large = folder.write("large.toml", std::string((1U << 20U) + 1, ' '));
  CHECK(load(large).diagnostics.at(0).code == "E0102");
}

TEST_CASE("include merges nodes, which keep their units and the folder of their files") {
  const Folder folder;
  folder.write("parts/cloud.pcd", "");
  folder.write("parts/common.toml",
               "units = \"cm\"\ntitle = \"not this\"\n[node.read]\n"
               "use = \"io.read_cloud\"\nfile = \"cloud.pcd\"\n[node.down]\n"
               "use = \"resampling.voxel_grid\"\nin = \"read\"\nsize = 5\n");
  const auto main = folder.write("main.toml",
                                 "include = \"parts/common.toml\"\nunits = \"mm\"\n"
                                 "title = \"main\"\n[node.finer]\n"
                                 "use = \"resampling.voxel_grid\"\nin = \"down\"\n"
                                 "size = 5\n");
  const auto loaded = load(main);
  CHECK(message(loaded).empty());
  REQUIRE(loaded.graph);
  const auto& graph = *loaded.graph;
  CHECK(graph.title == "main");
  CHECK(graph.units == "mm");
  const auto setting = [&](const char* node, std::size_t i) {
    return graph.nodes[graph.find(node).value()].settings[i];
  };
  CHECK(setting("down", 0) == velum::Setting{velum::Length(0.05)});
  CHECK(setting("finer", 0) == velum::Setting{velum::Length(0.005)});
  CHECK(setting("read", 0) == velum::Setting{(folder.path() / "parts/cloud.pcd").string()});
  CHECK(setting("read", 1) == velum::Setting{std::string("cm")});
}

TEST_CASE("mistakes of an included file are shown in it, after those of the main file") {
  const Folder folder;
  folder.write("b.toml", "tilte = 1\n");
  const auto main = folder.write("a.toml", "include = [\"b.toml\"]\n" + kScan + "x = 1\n");
  const auto diagnostics = load(main).diagnostics;
  REQUIRE(diagnostics.size() == 2);
  CHECK(diagnostics[0].file == main.string());
  CHECK(diagnostics[0].code == "E0203");
  CHECK(diagnostics[1].file == (folder.path() / "b.toml").string());
  CHECK(diagnostics[1].source_line == "tilte = 1");
}

TEST_CASE("E0103, E0104, E0302: what can go wrong with include") {
  const Folder folder;
  folder.write("a.toml", "include = \"b.toml\"\n" + kScan);
  folder.write("b.toml", "include = \"./a.toml\"\n");
  CHECK(lines_of(load(folder.path() / "a.toml").diagnostics) ==
        Lines{"E0103 1:11 './a.toml' includes itself | take one of the includes away"});
  // A node that may be in the file that is missing is not reported as well.
  const auto missing = folder.write("c.toml",
                                    "include = \"none.toml\"\n[node.n]\nuse = "
                                    "\"features.normals\"\nin = \"elsewhere\"\n");
  CHECK(lines_of(load(missing).diagnostics) ==
        Lines{"E0104 1:11 'none.toml' cannot be read: No such file or directory | the name is "
              "relative to the file that includes it"});
  folder.write("e.toml", kScan);
  const auto twice = folder.write("d.toml", "include = \"e.toml\"\n" + kScan);
  CHECK(lines_of(load(twice).diagnostics) ==
        Lines{"E0302 1:7 node 'scan' was there already | two files that are merged both have it: "
              "give one another name"});
  folder.write("f.toml", "include = \"e.toml\"\n");
  const auto diamond = folder.write("g.toml", "include = [\"e.toml\", \"f.toml\"]\n");
  CHECK(message(load(diamond)).empty());
}

TEST_CASE("E0210: overrides") {
  const std::string text = "units = \"mm\"\n" + kScan +
                           "[node.down]\nuse = \"resampling.voxel_grid\"\nin = \"scan\"\nsize = 5\n"
                           "[node.merge]\nuse = \"filtering.merge\"\nin = [\"scan\"]\n";
  const auto value = [&](const std::string& override) {
    const auto loaded = velum::test::load_text(text, {override});
    CHECK(message(loaded).empty());
    REQUIRE(loaded.graph);
    return loaded.graph->nodes[loaded.graph->find("down").value()].settings[0];
  };
  CHECK(value("down.size=7") == velum::Setting{velum::Length(0.007)});
  CHECK(value("down.size=7 cm") == velum::Setting{velum::Length(0.07)});
  CHECK(value("down.size=\"2 spacing\"") == velum::Setting{velum::spacings(2)});
  CHECK(value("merge.in=[\"scan\", \"down\"]") == velum::Setting{velum::Length(0.005)});
  CHECK(value("down.isolate=true") == velum::Setting{velum::Length(0.005)});

  const auto wrong = [&](const std::string& override) {
    return velum::test::mistakes(text, {override});
  };
  CHECK(
      wrong("down.size=-7") ==
      Lines{
          "E0206 1:11 'size' of node 'down' (resampling.voxel_grid) is -7; it must be above 0 m"});
  CHECK(
      wrong("dwon.size=7") ==
      Lines{"E0210 1:1 there is no node 'dwon' | did you mean 'down'? | known: down, merge, scan"});
  CHECK(wrong("down.sise=7") ==
        Lines{"E0203 1:6 unknown parameter 'sise' in node 'down' (resampling.voxel_grid) | did you "
              "mean 'size'? | known: size"});
  CHECK(wrong("size=7") == Lines{"E0210 1:1 'size=7' is no setting of a node | write "
                                 "node.parameter=VALUE"});
  CHECK(message(velum::test::load_text(text, {"down.size=-7"})) ==
        "error[E0206] --set:1:11  'size' of node 'down' (resampling.voxel_grid) is -7; it must be "
        "above 0 m\n    1 |   down.size=-7\n      |             ^^\n");
}

TEST_CASE("E0501: input files") {
  const Folder folder;
  folder.write("scan.pcd", "");
  fs::create_directory(folder.path() / "sub");
  REQUIRE(::mkfifo((folder.path() / "pipe").c_str(), 0600) == 0);
  const auto read = [&](const std::string& file) {
    return lines_of(
        load(folder.write("g.toml", "[node.r]\nuse = \"io.read_cloud\"\nfile = \"" + file + "\"\n"))
            .diagnostics);
  };
  CHECK(read("scan.pcd").empty());
  CHECK(read("./sub/../scan.pcd").empty());
  CHECK(read((folder.path() / "scan.pcd").string()).empty());
  const std::string of = "E0501 3:8 node 'r' (io.read_cloud): ";
  CHECK(read("scam.pcd") == Lines{of + "there is no file 'scam.pcd' | did you mean 'scan.pcd'?"});
  CHECK(read("sub") == Lines{of + "'sub' is a folder, not a file"});
  CHECK(read("pipe") == Lines{of + "'pipe' is no regular file"});
  CHECK(read("none/x.pcd") ==
        Lines{of + "there is no file 'none/x.pcd' | the name is relative to the graph's folder"});
}

TEST_CASE("E0502: output files") {
  const std::string of = "E0502 6:8 node 'w' (io.write_cloud): ";
  CHECK(write("a/b.ply").empty());
  CHECK(write("/tmp/b.ply") == Lines{of + "'/tmp/b.ply' is an absolute path | outputs are written "
                                          "below --out: give a relative name"});
  CHECK(write("a/../../b.ply") ==
        Lines{of + "'a/../../b.ply' leaves the output folder | outputs are written below --out"});
  CHECK(write("a/") == Lines{of + "'a/' names no file"});
  CHECK(write(".") == Lines{of + "'.' names no file"});
  CHECK(write("./run.json") == Lines{of + "'./run.json' is a name of the run's own | choose "
                                          "another name"});
  CHECK(write(".velum.scratch/x.ply").size() == 1);
  CHECK(write("run.json/x.ply").size() == 1);
  const Folder folder;
  folder.write("file", "");
  fs::create_directory(folder.path() / "there.ply");
  CHECK(write("new.ply", folder.path() / "not/yet").empty());
  CHECK(write("there.ply", folder.path()) ==
        Lines{of + "'" + (folder.path() / "there.ply").string() +
              "' cannot be written: it is there and is no regular file"});
  CHECK(write("x.ply", folder.path() / "file") ==
        Lines{of + "'x.ply' cannot be written: '" + (folder.path() / "file").string() +
              "' is no folder"});
  if (::geteuid() == 0) {
    WARN("skipped: root may write everywhere");
    return;
  }
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  CHECK(write("x.ply", folder.path()).at(0).find("no permission") != std::string::npos);
  fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST_CASE("E0503: two nodes that write one file") {
  const auto writer = [](const std::string& name, const std::string& file) {
    return "[node." + name + "]\nuse = \"io.write_cloud\"\nin = \"scan\"\nfile = \"" + file +
           "\"\n";
  };
  CHECK(
      velum::test::mistakes(kScan + writer("a", "x.ply") + writer("b", "./x.ply")) ==
      Lines{"E0503 10:8 node 'b' (io.write_cloud): './x.ply' is written by node 'a' too | give one "
            "of them another name"});
}

TEST_CASE("E0202, E0601: the form of a study") {
  CHECK(
      velum::test::mistakes(kScan + R"(
[study]
repeat = 0
measures = []
measure = ["scan.points", "total.seconds", "scna.x", 3]
[[study.vary]]
node = "scam"
alternatives = [{ use = "x" }, 3]
[[study.vary]]
param = "scan.sweep"
[[study.vary]]
param = "scan"
values = []
valeus = 3
[[study.vary]]
)") ==
      Lines{
          "E0206 5:10 'repeat' is 0; it must be at least 1",
          "E0202 6:1 unknown key 'measures' of [study] | did you mean 'measure'? | known: title, "
          "repeat, seed, measure, vary, exclude, sample, reference, timing, timeout, memory, slurm",
          "E0404 7:44 the study names 'scna', but there is no such node | did you mean 'scan'? | "
          "known: scan",
          "E0601 7:54 a measure is written \"node.name\"",
          "E0404 9:8 the study names 'scam', but there is no such node | did you mean 'scan'? | "
          "known: scan",
          "E0204 10:32 an alternative must be a table such as { use = ... }",
          "E0601 12:1 an axis of a parameter has either values or files | add values = [...]",
          "E0601 14:9 'param' is written \"node.name\"", "E0601 15:1 this axis has no values",
          "E0202 16:1 unknown key 'valeus' of [[study.vary]] | did you mean 'values'? | known: "
          "title, zip, node, alternatives, param, values, range, files, rows",
          "E0601 17:1 an axis of a study varies either a node or a parameter | give either node "
          "and alternatives, or param and values (or range, or files), or rows"});
}
