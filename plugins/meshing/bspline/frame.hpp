// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace velum::meshing {

/// Parameters from a sheet's own shape: v runs from foot to head, u from one upright edge to the
/// other, following both. Where the sheet is much narrower than elsewhere (a pointed head) u-lines
/// draw no closer together, so that there is no pole.
class SheetFrame {
 public:
  SheetFrame() = default;
  /// `plane` holds the unrolled sheet, y upward [m]; all of it gets parameters within [0, 1] and at
  /// least `margin` [m], in x and in y, off the ends.
  SheetFrame(const Eigen::Matrix2Xd& plane, const Eigen::Vector2d& margin);

  [[nodiscard]] Eigen::Vector2d to_uv(const Eigen::Vector2d& q) const;
  [[nodiscard]] Eigen::Vector2d to_plane(const Eigen::Vector2d& uv) const;
  /// Derivatives of to_plane: columns by u and by v.
  [[nodiscard]] Eigen::Matrix2d jacobian(const Eigen::Vector2d& uv) const;
  /// Usual extent of the whole range [m].
  [[nodiscard]] double width() const { return width_; }
  [[nodiscard]] double height() const { return height_; }

 private:
  struct Middle {
    double centre, half, centre_slope, half_slope;
  };
  [[nodiscard]] Middle middle_at(double v) const;
  double low_ = 0.0;
  double height_ = 1.0;
  double width_ = 1.0;
  double floor_ = 0.0;
  double stretch_ = 1.0;
  Eigen::Vector4d centre_ = Eigen::Vector4d::Zero();  // polynomials in v
  Eigen::Vector4d half_ = Eigen::Vector4d::Zero();
};

}  // namespace velum::meshing
