// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

namespace velum::sail {

/// A smooth curve as a fine polyline, in sail axes (x aft, z up).
class Curve {
 public:
  Curve() = default;
  explicit Curve(Eigen::Matrix3Xd points) : points_(std::move(points)) {}

  [[nodiscard]] const Eigen::Matrix3Xd& points() const { return points_; }
  [[nodiscard]] bool empty() const { return points_.cols() < 2; }
  [[nodiscard]] Eigen::Vector3d front() const { return points_.col(0); }
  [[nodiscard]] Eigen::Vector3d back() const { return points_.col(points_.cols() - 1); }
  [[nodiscard]] double length() const;
  /// Unit tangents at the ends, in the direction of the curve.
  [[nodiscard]] Eigen::Vector3d start_direction() const;
  [[nodiscard]] Eigen::Vector3d end_direction() const;
  [[nodiscard]] Curve reversed() const;
  /// Cut, or lengthened by a straight piece, so that it ends at `end`.
  [[nodiscard]] Curve ending_at(const Eigen::Vector3d& end) const;
  [[nodiscard]] Curve starting_at(const Eigen::Vector3d& start) const;
  /// Where it first comes to height `z`, counted from its front.
  [[nodiscard]] std::optional<Eigen::Vector3d> at_height(double z) const;
  /// The point nearest to `p`: its share of the curve's samples, 0 to 1.
  [[nodiscard]] double nearest(const Eigen::Vector3d& p) const;

 private:
  Eigen::Matrix3Xd points_;
};

/// A smooth curve through points that scatter about it, given in order along it: penalised cubic
/// B-splines of the arc length, at most one span for six points and at most twelve. Noise across
/// the curve averages out, so that its length is not that of the points' zigzag. `share` is where
/// along the curve each point lies, ascending from 0 to 1, at first guess.
[[nodiscard]] Curve smooth_curve(const Eigen::Matrix3Xd& points, Eigen::VectorXd share,
                                 const Eigen::VectorXd& weights);

}  // namespace velum::sail
