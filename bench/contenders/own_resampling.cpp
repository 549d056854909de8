// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "own.hpp"

namespace bench {
namespace {

Make mls(const std::string& border) {
  return [=](const Input& input) {
    return Stage("resampling.mls")
        .set("radius", metres(input.radius))
        .set("order", "2")
        .set("border", border);
  };
}

void add_libraries(Contenders& all) {
  all.push_back(on_cloud(
      "PCL's MLS wrapped, order 2", &Input::cloud,
      [](const Input& input) {
        return Stage("resampling.pcl_mls").set("radius", metres(input.radius)).set("order", "2");
      },
      kSlow));
  all.push_back(on_cloud(
      "CGAL's jets wrapped, k = 50", &Input::cloud,
      [](const Input&) { return Stage("resampling.cgal_jet").set("neighbours", "50"); }, kSlow));
  all.push_back(on_cloud(
      "CGAL's bilateral wrapped, k = 50", &Input::normals,
      [](const Input&) { return Stage("resampling.cgal_bilateral").set("neighbours", "50"); },
      kSlow));
  all.push_back(on_cloud(
      "CGAL's WLOP wrapped, 5 rounds", &Input::cloud,
      [](const Input& input) {
        return Stage("resampling.cgal_wlop")
            .set("radius", metres(input.radius))
            .set("iterations", "5");
      },
      kSlowest));
}

}  // namespace

Contenders own_resampling() {
  Contenders all;
  add_both(all, "voxel grid", &Input::cloud, [](const Input& input) {
    return Stage("resampling.voxel_grid").set("size", metres(input.radius));
  });
  add_both(all, "MLS, order 2", &Input::cloud, mls("plain"));
  add_both(all, "MLS, order 2, aware of borders", &Input::cloud, mls("aware"), kSlow);
  add_both(
      all, "upsample to half the spacing", &Input::smooth,
      [](const Input& input) {
        return Stage("resampling.upsample").set("spacing", metres(0.125 * input.radius));
      },
      kSlow);
  add_libraries(all);
  return all;
}

}  // namespace bench
