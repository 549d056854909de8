// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/mesh.hpp>

namespace velum::sail {

/// A sail's mesh in sail axes: x aft, z up, y to make them right-handed.
struct Sheet {
  Mesh mesh;
  /// Rows: the axes aft, side and up in the mesh's frame.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Eigen::Matrix3Xd points;         ///< vertices, about the mesh's origin [m]
  std::vector<std::int32_t> loop;  ///< vertices around the longest border
  double spacing = 0.0;            ///< median length of the border's edges [m]

  /// From sail axes to true coordinates.
  [[nodiscard]] Eigen::Vector3d true_position(const Eigen::Vector3d& p) const {
    return mesh.origin() + axes.transpose() * p;
  }
};

/// Throws Error (Fault::stage) when `up` and `bow` are parallel, or the mesh has no border.
[[nodiscard]] Sheet make_sheet(const Mesh& mesh, const Eigen::Vector3d& up,
                               const Eigen::Vector3d& bow);

}  // namespace velum::sail
