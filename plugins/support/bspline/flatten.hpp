// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bspline/evaluate.hpp"

namespace velum::bspline {

/// Maps (u, v) to a plane: x is the length along u on the surface, counted from the middle of the
/// range, y the length along the middle. One to one wherever u-lines have a length, so that
/// polygons in (u, v) do not cross each other in the plane.
class Flat {
 public:
  explicit Flat(const Patch& patch);

  [[nodiscard]] Eigen::Vector2d to_plane(const Eigen::Vector2d& uv) const;
  /// The place of height y, and the range of x there.
  struct Row {
    double v = 0.0;
    double left = 0.0;
    double right = 0.0;
  };
  [[nodiscard]] double height() const { return along_[kRows]; }
  [[nodiscard]] Row row_at(double y) const;
  /// u of the place x in the row of v.
  [[nodiscard]] double u_at(double x, double v) const;

 private:
  static constexpr Index kRows = 128;
  static constexpr Index kColumns = 64;
  [[nodiscard]] double x_at(Index column, double v) const;
  Eigen::Vector2d low_;
  Eigen::Vector2d size_;
  Eigen::MatrixXd across_;  // length along u up to each column, from the middle; a row a v
  Eigen::VectorXd along_;   // length along the middle up to each row
};

}  // namespace velum::bspline
