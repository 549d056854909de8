// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace velum::geometry {

/// Running mean and covariance of points given as offsets from a point near them. Offsets are exact
/// in single precision for points of one neighbourhood; the sums are in double.
class NeighbourMoments {
 public:
  void add(const Eigen::Vector3f& offset) {
    const Eigen::Vector3d d = offset.cast<double>();
    const Eigen::Vector4d row(d.x(), d.y(), d.z(), 1.0);
    x_ += d.x() * row;
    y_ += d.y() * row;
    z_ += d.z() * row;
    ++count_;
  }

  [[nodiscard]] Eigen::Index count() const { return count_; }
  [[nodiscard]] Eigen::Vector3d mean() const {
    return Eigen::Vector3d(x_[3], y_[3], z_[3]) / static_cast<double>(count_);
  }
  /// (1/k) Σ (p − p̄)(p − p̄)ᵀ (thesis 3.1).
  [[nodiscard]] Eigen::Matrix3d covariance() const {
    Eigen::Matrix3d m;
    m.col(0) = x_.head<3>();
    m.col(1) = y_.head<3>();
    m.col(2) = z_.head<3>();
    const Eigen::Vector3d centre = mean();
    return m / static_cast<double>(count_) - centre * centre.transpose();
  }

 private:
  Eigen::Vector4d x_ = Eigen::Vector4d::Zero();
  Eigen::Vector4d y_ = Eigen::Vector4d::Zero();
  Eigen::Vector4d z_ = Eigen::Vector4d::Zero();
  Eigen::Index count_ = 0;
};

}  // namespace velum::geometry
