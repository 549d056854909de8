// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "own.hpp"

namespace bench {

Contenders own_features() {
  Contenders all;
  add_both(all, "normals, k = 50", &Input::cloud,
           [](const Input&) { return Stage("features.normals").set("neighbours", "50"); });
  all.push_back(on_cloud("PCL's normals wrapped, k = 50", &Input::cloud, [](const Input&) {
    return Stage("features.pcl_normals").set("neighbours", "50");
  }));
  add_both(
      all, "FPFH, k = 50", &Input::normals,
      [](const Input&) { return Stage("features.fpfh").set("neighbours", "50"); }, kSlow);
  add_both(
      all, "PFH, k = 20", &Input::normals,
      [](const Input&) { return Stage("features.pfh").set("neighbours", "20"); }, kSlowest);
  return all;
}

}  // namespace bench
