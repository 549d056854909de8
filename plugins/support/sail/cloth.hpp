// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "sail/rim.hpp"
#include "sail/section.hpp"

namespace velum::sail {

/// A sail that is a B-spline surface, measured without a mesh. Refers to the surface.
class Cloth {
 public:
  /// Throws Error when the surface is not sound or its outer border encloses nothing
  /// (Fault::stage), or `up` and `bow` are parallel (Fault::graph).
  Cloth(const Surface& surface, const Eigen::Vector3d& up, const Eigen::Vector3d& bow,
        Context& context);

  [[nodiscard]] const Frame& frame() const { return frame_; }
  [[nodiscard]] const Outline& outline() const { return outline_; }
  /// The outline between its corners, as it is.
  [[nodiscard]] Border border() const;
  /// The cut by the plane at height z of sail axes: points by Newton's method on the surface, entry
  /// and exit from its derivatives. Throws Error (Fault::stage) when the plane does not cut the
  /// border twice.
  [[nodiscard]] RawSection section(double z) const;
  /// Inside the outer border and outside of holes [m²].
  [[nodiscard]] double area(Context& context) const;

 private:
  struct End {
    Eigen::Vector2d uv;
    Eigen::Vector3d at;  ///< in sail axes
  };
  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector2d& uv) const {
    return frame_.axes * patch_.at(uv);
  }
  [[nodiscard]] Eigen::Vector2d root(Eigen::Vector2d a, Eigen::Vector2d b, double z) const;
  [[nodiscard]] std::optional<End> crossing(Index from, Index to, double z) const;
  [[nodiscard]] Eigen::Vector2d tangent(const Eigen::Vector2d& uv) const;
  [[nodiscard]] std::vector<Eigen::Vector2d> cut(double z) const;

  bspline::Patch patch_;
  Frame frame_;
  std::vector<Eigen::Matrix2Xd> loops_;
  Eigen::Matrix2Xd rim_;  ///< (u, v) of the outline's points
  Outline outline_;
  Eigen::MatrixXd heights_;  ///< of a grid of (u, v)
};

}  // namespace velum::sail
