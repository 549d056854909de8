// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// The resolved text, which a run writes beside its results.
#include <catch2/catch.hpp>

#include "graph_support.hpp"

namespace {

// A graph with everything that a graph may say; common.toml has the node 'read'.
constexpr const char* kEverything = R"(
include = "common.toml"
title = "with \"quotes\" and é"
units = "mm"
[node.scan]
use = "devices.simulator"
title = "Scan"
seed = 3
sweep = "250 ms"
[node.normals]
use = "features.normals"
in = "scan"
isolate = true
limits = { time = "2 min", memory = "1 GiB" }
cache = false
[node.grow]
use = "segmentation.region_growing"
in = "normals"
smoothness = 7
curvature = "5 %"
[node.sail]
use = "filtering.select_cluster"
in = "grow"
which = "containing"
point = [100, "3 ft", 0.1]
[node.svd]
use = "registration.svd"
in = { source = "sail", target = "read" }
up = [0.1, 0.2, 1]
weights = [0.1, 0.3]
note = "a\nb"
pairs = [{ source = [1, 2, 3], target = [4, 5, 6] }, { source = [1, 2, 3], target = [0.1, 1, 1], weight = 3 }]
[node.all]
use = "filtering.merge"
in = ["svd", "scan"]
[node.down]
use = "resampling.voxel_grid"
in = "all"
leaf = 5
[node.mesh]
use = "meshing.delaunay_projected"
in = "down"
max_edge = "1.7 % diagonal"
[node.write]
use = "io.write_cloud"
in = "all"
file = "a/./b.ply"
extras = ["in.pcd", "common.toml"]
[study]
repeat = 5
measure = ["total.seconds"]
[[study.vary]]
param = "down.size"
values = [3, 4.0, "5 mm", 1979-05-27T07:32:00Z]
[[study.vary]]
node = "mesh"
alternatives = [{ use = "meshing.delaunay_projected", max_edge = 3, "odd key" = {} }]
)";

bool same(const velum::graph::Graph& a, const velum::graph::Graph& b) {
  if (a.nodes.size() != b.nodes.size() || a.title != b.title || a.units != b.units) return false;
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    const auto& x = a.nodes[i];
    const auto& y = b.nodes[i];
    if (x.name != y.name || x.use != y.use || x.title != y.title || x.inputs != y.inputs ||
        x.settings != y.settings || x.isolate != y.isolate || x.allow_empty != y.allow_empty ||
        x.cache != y.cache || x.seed != y.seed || !(x.limits == y.limits))
      return false;
  }
  return true;
}

}  // namespace

TEST_CASE("the resolved text is the same graph") {
  const velum::test::Folder folder;
  folder.write("in.pcd", "");
  folder.write("common.toml",
               "units = \"in\"\n[node.read]\nuse = \"io.read_cloud\"\n"
               "file = \"in.pcd\"\nallow_empty = true\n");
  const auto main = folder.write("main.toml", kEverything);
  const auto first = velum::graph::load(main, {"down.size=9"}, velum::test::catalog(), {});
  CHECK(velum::graph::format(first.diagnostics).empty());
  REQUIRE(first.graph);
  INFO(first.graph->resolved);
  const auto second = velum::graph::load_text(first.graph->resolved, "/elsewhere/run.toml", {},
                                              velum::test::catalog());
  CHECK(velum::graph::format(second.diagnostics).empty());
  REQUIRE(second.graph);
  CHECK(same(*first.graph, *second.graph));
  CHECK(second.graph->resolved == first.graph->resolved);
  REQUIRE(second.graph->study);
  CHECK(second.graph->study->find("vary")->value.items.size() == 2);
  CHECK(first.graph->nodes[first.graph->find("down").value()].settings[0] ==
        velum::Setting{velum::Length(0.009)});
}
