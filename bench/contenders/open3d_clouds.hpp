// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <open3d/Open3D.h>

#include "timing.hpp"

/// Our clouds as Open3D's.
namespace bench::open3d_clouds {

using Cloud = open3d::geometry::PointCloud;

inline std::shared_ptr<Cloud> convert(const velum::Cloud& cloud) {
  auto out = std::make_shared<Cloud>();
  const auto p = cloud.positions();
  for (velum::Index i = 0; i < p.cols(); ++i) out->points_.push_back(p.col(i).cast<double>());
  if (cloud.has(velum::column::kNormals)) {
    const auto n = cloud.normals();
    for (velum::Index i = 0; i < n.cols(); ++i) out->normals_.push_back(n.col(i).cast<double>());
  }
  return out;
}

}  // namespace bench::open3d_clouds
