// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "own.hpp"

namespace bench {
namespace {

Contender decimation() {
  return own(
      "repair and decimate to half",
      [](const Input& input) {
        const auto mesh = Stage("meshing.delaunay_projected").run(input.smooth).mesh();
        const std::string half = std::to_string(mesh.size() / 2);
        return [mesh, stage = Stage("meshing.repair").set("triangles", half)]() mutable {
          stage.run(mesh);
        };
      },
      kSlow);
}

}  // namespace

Contenders own_meshing() {
  Contenders all;
  add_both(all, "meshing", &Input::smooth, [](const Input& input) {
    return Stage("meshing.delaunay_projected").set("max_edge", metres(4.0 * input.radius));
  });
  all.push_back(on_cloud(
      "PCL's greedy projection wrapped", &Input::smooth,
      [](const Input& input) {
        return Stage("meshing.greedy_projection").set("max_edge", metres(2.0 * input.radius));
      },
      kSlow));
  all.push_back(on_cloud(
      "CGAL's advancing front wrapped", &Input::smooth,
      [](const Input&) { return Stage("meshing.advancing_front"); }, kSlow));
  all.push_back(on_cloud(
      "Delaunay tetrahedra, short faces", &Input::smooth,
      [](const Input&) { return Stage("meshing.delaunay_3d"); }, kSlow));
  all.push_back(on_cloud(
      "PCL's Poisson wrapped, depth 8", &Input::smooth,
      [](const Input&) { return Stage("meshing.poisson").set("depth", "8"); }, kSlow));
  all.push_back(on_cloud(
      "B-spline surface", &Input::cloud, [](const Input&) { return Stage("meshing.bspline"); },
      kSlowest));
  all.push_back(decimation());
  return all;
}

}  // namespace bench
