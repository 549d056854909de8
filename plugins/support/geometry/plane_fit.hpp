// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/eigen3.hpp"
#include "velum/types.hpp"

namespace velum::geometry {

/// The plane normal · x = normal · centroid that fits a set of points best.
struct PlaneFit {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  /// Mean squares along the principal axes [m²], ascending: the first is across the plane.
  Eigen::Vector3d spread = Eigen::Vector3d::Zero();

  [[nodiscard]] double offset() const { return normal.dot(centroid); }
  [[nodiscard]] double distance(const Eigen::Vector3d& point) const {
    return normal.dot(point - centroid);
  }
  /// RMS distance of the points from the plane [m].
  [[nodiscard]] double rms() const;
  /// λ0/Σλ (thesis 3.2): 0 for a plane, at most 1/3.
  [[nodiscard]] double curvature() const;
};

/// Weight, first and second moments of a set of points, summed about a reference near them so that
/// nothing cancels. Sets are joined by adding their moments about one reference.
class PointMoments {
 public:
  explicit PointMoments(const Eigen::Vector3d& reference = Eigen::Vector3d::Zero())
      : reference_(reference) {}

  void add(const Eigen::Vector3d& point, double weight = 1.0) {
    const Eigen::Vector3d d = point - reference_;
    weight_ += weight;
    sum_ += weight * d;
    squares_.noalias() += (weight * d) * d.transpose();
  }
  void add(const PointMoments& other);

  [[nodiscard]] double weight() const { return weight_; }
  [[nodiscard]] Eigen::Vector3d centroid() const;
  /// Mean outer product about the centroid [m²].
  [[nodiscard]] Eigen::Matrix3d covariance() const;
  /// Needs a positive weight; the normal of fewer than three points, or of points on a line, is one
  /// of the many that fit.
  [[nodiscard]] PlaneFit plane() const;

 private:
  Eigen::Vector3d reference_;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares_ = Eigen::Matrix3d::Zero();
  double weight_ = 0.0;
};

}  // namespace velum::geometry
