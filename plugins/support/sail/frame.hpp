// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/values.hpp>

namespace velum::sail {

/// Sail axes: x aft, z up, y to make them right-handed, about an origin.
struct Frame {
  /// Rows: the axes aft, side and up in the given frame.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();

  /// From sail axes to true coordinates.
  [[nodiscard]] Eigen::Vector3d true_position(const Eigen::Vector3d& p) const {
    return origin + axes.transpose() * p;
  }
  /// Height of the origin along `up`, true coordinates [m].
  [[nodiscard]] double datum() const { return axes.row(2).dot(origin); }
};

/// Throws Error (Fault::graph) when `up` and `bow` are zero or parallel.
[[nodiscard]] Frame make_frame(const Eigen::Vector3d& up, const Eigen::Vector3d& bow,
                               const Eigen::Vector3d& origin);

/// Median length of the edges of a closed polygon [m].
[[nodiscard]] double median_edge(const Eigen::Matrix3Xd& polygon);

}  // namespace velum::sail
