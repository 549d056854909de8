// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/mesh.hpp>

#include "sail/frame.hpp"

namespace velum::sail {

/// A sail's mesh in sail axes.
struct Sheet {
  Mesh mesh;
  Frame frame;                     ///< about the mesh's origin
  Eigen::Matrix3Xd points;         ///< vertices, about the mesh's origin [m]
  std::vector<std::int32_t> loop;  ///< vertices around the longest border
  double spacing = 0.0;            ///< median length of the border's edges [m]

  /// The border's vertices, in order.
  [[nodiscard]] Eigen::Matrix3Xd border() const;
};

/// Throws Error when `up` and `bow` are parallel (Fault::graph), or the mesh has no border
/// (Fault::stage).
[[nodiscard]] Sheet make_sheet(const Mesh& mesh, const Eigen::Vector3d& up,
                               const Eigen::Vector3d& bow);

}  // namespace velum::sail
