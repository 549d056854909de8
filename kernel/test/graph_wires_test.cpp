// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Wires: all their forms, and one case a kind of mistake in them.
#include <catch2/catch.hpp>

#include <algorithm>

#include "graph_support.hpp"

using velum::graph::Wire;
using velum::test::mistakes;
using Lines = std::vector<std::string>;

namespace {

const std::string kTwo =
    "[node.a]\nuse = \"devices.simulator\"\n"
    "[node.b]\nuse = \"devices.simulator\"\n";

Lines icp(const std::string& in, const std::string& more = "") {
  return mistakes(kTwo + "[node.icp]\nuse = \"registration.icp\"\n" + in + "\n" + more);
}

/// Names of the sources of each input: "a.0".
std::vector<Lines> sources(const velum::graph::Graph& graph, const std::string& name) {
  std::vector<Lines> inputs;
  for (const auto& wires : graph.nodes[graph.find(name).value()].inputs) {
    auto& input = inputs.emplace_back();
    for (const Wire& wire : wires)
      input.push_back(fmt::format("{}.{}", graph.nodes[wire.node].name, wire.output));
  }
  return inputs;
}

}  // namespace

TEST_CASE("every form of a wire") {
  const auto loaded = velum::test::load_text(kTwo + R"(
[node.all]
use = "filtering.merge"
in = ["b", "a.cloud"]
[node.one]
use = "filtering.merge"
in = { clouds = "a" }
[node.icp]
use = "registration.icp"
in = { source = "a", target = "all" }
[node.moved]
use = "filtering.transform"
in = { transform = "icp.transform", cloud = "b" }
[node.plain]
use = "filtering.transform"
in = "b"
[node.normals]
use = "features.normals"
in = "plain"
[node.parts]
use = "segmentation.region_growing"
in = "normals"
[node.sail]
use = "filtering.select_cluster"
in = "parts"
[node.sail_of_cloud]
use = "filtering.select_cluster"
in = { cloud = "plain" }
)");
  REQUIRE(velum::graph::format(loaded.diagnostics).empty());
  const auto& graph = *loaded.graph;
  CHECK(sources(graph, "all") == std::vector<Lines>{{"b.0", "a.0"}});
  CHECK(sources(graph, "one") == std::vector<Lines>{{"a.0"}});
  CHECK(sources(graph, "icp") == std::vector<Lines>{{"a.0"}, {"all.0"}});
  CHECK(sources(graph, "moved") == std::vector<Lines>{{"b.0"}, {"icp.1"}});
  CHECK(sources(graph, "plain") == std::vector<Lines>{{"b.0"}, {}});
  CHECK(sources(graph, "sail") == std::vector<Lines>{{"parts.0"}});
  CHECK(sources(graph, "sail_of_cloud") == std::vector<Lines>{{"plain.0"}});
  CHECK(sources(graph, "a").empty());
}

TEST_CASE("nodes come after those they take from, by name where free, whatever the file's order") {
  const std::vector<std::string> nodes = {
      "[node.z]\nuse = \"devices.simulator\"\n", "[node.b]\nuse = \"devices.simulator\"\n",
      "[node.m]\nuse = \"filtering.merge\"\nin = [\"z\", \"b\"]\n",
      "[node.a]\nuse = \"features.normals\"\nin = \"m\"\n"};
  std::vector<std::size_t> order = {0, 1, 2, 3};
  do {
    std::string text;
    for (const std::size_t i : order) text += nodes[i];
    const auto loaded = velum::test::load_text(text);
    REQUIRE(loaded.graph);
    Lines names;
    for (const auto& node : loaded.graph->nodes) names.push_back(node.name);
    CHECK(names == Lines{"b", "z", "m", "a"});
  } while (std::ranges::next_permutation(order).found);
}

TEST_CASE("E0401: missing input") {
  CHECK(icp("") ==
        Lines{"E0401 5:7 node 'icp' (registration.icp) lacks its input 'source' (cloud) | "
              "add in = \"NODE\"",
              "E0401 5:7 node 'icp' (registration.icp) lacks its input 'target' (cloud) | "
              "add in = { target = \"NODE\" }"});
  CHECK(
      icp("in = \"a\"") ==
      Lines{"E0401 5:7 node 'icp' (registration.icp) lacks its input 'target' (cloud) | add in = { "
            "target = \"NODE\" }"});
  CHECK(mistakes("[node.m]\nuse = \"filtering.merge\"\nin = []\n") ==
        Lines{"E0401 1:7 node 'm' (filtering.merge) lacks its input 'clouds' (cloud) | add in = "
              "[\"NODE\", \"NODE\"]"});
  CHECK(
      mistakes("[node.s]\nuse = \"filtering.select_cluster\"\n") ==
      Lines{"E0401 1:7 node 's' (filtering.select_cluster) lacks its input 'clusters' (clusters or "
            "cloud) | add in = \"NODE\""});
}

TEST_CASE("E0402: an input that the stage does not have") {
  CHECK(icp("in = { source = \"a\", traget = \"b\", target = \"b\" }") ==
        Lines{"E0402 7:22 node 'icp' (registration.icp) has no input 'traget' | did you mean "
              "'target'? | known: source, target"});
  CHECK(mistakes("[node.a]\nuse = \"devices.simulator\"\nin = \"a\"\n") ==
        Lines{"E0402 3:1 node 'a' (devices.simulator) takes no input"});
}

TEST_CASE("E0403: an input that is used twice") {
  CHECK(mistakes(kTwo + "[node.s]\nuse = \"filtering.select_cluster\"\n"
                        "in = { cloud = \"a\", clusters = \"b\" }\n") ==
        Lines{
            "E0403 7:21 input 'clusters' of node 's' (filtering.select_cluster) is wired twice | "
            "keep one of them",
        });
  CHECK(
      icp("in = { source = \"a\", target = \"b\", target = \"a\" }").at(0).starts_with("E0101 7:"));
}

TEST_CASE("E0404: unknown node") {
  CHECK(
      mistakes(kTwo + "[node.normals]\nuse = \"features.normals\"\nin = \"nromals\"\n"
                      "[node.n2]\nuse = \"features.normals\"\nin = \"nromals.cloud\"\n") ==
      Lines{
          "E0404 7:6 node 'normals' (features.normals) takes from 'nromals', but there is no such "
          "node | known: a, b, n2",
          "E0404 10:6 node 'n2' (features.normals) takes from 'nromals', but there is no such node "
          "| did you mean 'normals'? | known: a, b, normals"});
  CHECK(mistakes("[node.x]\nuse = \"features.normalz\"\nin = { cloud = [\"nobody\"] }\n").at(1) ==
        "E0404 3:17 node 'x' (features.normalz) takes from 'nobody', but there is no such node");
}

TEST_CASE("E0405: unknown output") {
  CHECK(
      icp("in = { source = \"a.clod\", target = \"b\" }") ==
      Lines{
          "E0405 7:17 node 'a' (devices.simulator) has no output 'clod' | did you mean 'cloud'? | "
          "known: cloud"});
  CHECK(mistakes(kTwo + "[node.w]\nuse = \"io.write_cloud\"\nin = \"a\"\nfile = \"x.ply\"\n"
                        "[node.n]\nuse = \"features.normals\"\nin = \"w\"\n") ==
        Lines{"E0405 11:6 node 'w' (io.write_cloud) has no output to take"});
}

TEST_CASE("E0406: a wire of the wrong type says what would fit") {
  CHECK(
      icp("in = { source = \"a\", target = \"b\" }",
          "[node.m]\nuse = \"features.normals\"\nin = \"icp.transform\"\n") ==
      Lines{
          "E0406 10:6 input 'cloud' of node 'm' (features.normals) takes cloud; 'icp.transform' is "
          "transform | \"icp.cloud\" would fit"});
  CHECK(
      mistakes(kTwo + "[node.q]\nuse = \"analysis.mesh_to_reference\"\n"
                      "in = { mesh = \"a\", reference = \"b\" }\n") ==
      Lines{
          "E0406 7:15 input 'mesh' of node 'q' (analysis.mesh_to_reference) takes mesh; 'a.cloud' "
          "is cloud",
          "E0406 7:32 input 'reference' of node 'q' (analysis.mesh_to_reference) takes mesh or "
          "surface; 'b.cloud' is cloud"});
}

TEST_CASE("E0407: needs") {
  const std::string grow = "[node.grow]\nuse = \"segmentation.region_growing\"\nin = ";
  const std::string advice = " | put a node with use = \"features.normals\" before it";
  SECTION("a column that certainly is not there") {
    CHECK(
        mistakes(kTwo + grow + "\"a\"\n") ==
        Lines{"E0407 7:6 input 'cloud' of node 'grow' (segmentation.region_growing) needs normals; "
              "'a.cloud' has none" +
              advice});
  }
  SECTION("through stages that keep columns") {
    CHECK(mistakes(kTwo + "[node.m]\nuse = \"filtering.merge\"\nin = [\"a\", \"b\"]\n" + grow +
                   "\"m\"\n")
              .size() == 1);
    CHECK(mistakes(kTwo +
                   "[node.n]\nuse = \"features.normals\"\nin = \"a\"\n"
                   "[node.m]\nuse = \"filtering.transform\"\nin = \"n\"\n" +
                   grow + "\"m\"\n")
              .empty());
  }
  SECTION("a file may hold any column") {
    const velum::test::Folder folder;
    folder.write("x.pcd", "");
    const auto loaded = velum::graph::load_text(
        "[node.a]\nuse = \"io.read_cloud\"\nfile = \"x.pcd\"\n" + grow + "\"a\"\n",
        folder.path() / "g.toml", {}, velum::test::catalog());
    CHECK(loaded.graph);
  }
  SECTION("only with a value of a parameter") {
    CHECK(icp("in = { source = \"a\", target = \"b\" }").empty());
    CHECK(
        icp("in = { source = \"a\", target = \"b\" }\nmetric = \"point_to_plane\"") ==
        Lines{"E0407 7:31 input 'target' of node 'icp' (registration.icp) needs normals; 'b.cloud' "
              "has none" +
              advice});
  }
}

TEST_CASE("E0408: cycles are printed") {
  const auto merge = [](const std::string& name, const std::string& in) {
    return "[node." + name + "]\nuse = \"filtering.merge\"\nin = [" + in + "]\n";
  };
  CHECK(
      mistakes(merge("a", "\"c\"") + merge("b", "\"a\"") + merge("c", "\"b\"")) ==
      Lines{"E0408 6:7 the nodes take from each other in a circle: a -> b -> c -> a | take one of "
            "these wires away"});
  CHECK(
      mistakes(merge("a", "\"a\"")) ==
      Lines{
          "E0408 3:7 the nodes take from each other in a circle: a -> a | take one of these wires "
          "away"});
  CHECK(mistakes(merge("a", "\"b\"") + merge("b", "\"a\"") + merge("c", "\"d\"") +
                 merge("d", "\"c\""))
            .size() == 2);
}

TEST_CASE("E0409: several values for an input that takes one") {
  CHECK(
      icp("in = [\"a\", \"b\"]") ==
      Lines{"E0409 7:6 input 'source' of node 'icp' (registration.icp) takes one value | name the "
            "inputs: in = { source = ..., target = ... }"});
  CHECK(
      mistakes(kTwo + "[node.n]\nuse = \"features.normals\"\nin = [\"a\", \"b\"]\n") ==
      Lines{"E0409 7:6 input 'cloud' of node 'n' (features.normals) takes one value | take values "
            "together with filtering.merge"});
}

TEST_CASE("wires must be text") {
  CHECK(mistakes(kTwo + "[node.n]\nuse = \"features.normals\"\nin = 3\n") ==
        Lines{"E0204 7:6 a wire of node 'n' (features.normals) must be text: \"node\" or "
              "\"node.output\""});
  CHECK(mistakes(kTwo + "[node.m]\nuse = \"filtering.merge\"\nin = [3, \"a\"]\n") ==
        Lines{"E0204 7:7 a wire of node 'm' (filtering.merge) must be text"});
}
