// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "geometry/plane_fit.hpp"

#include <algorithm>
#include <cmath>

namespace velum::geometry {

double PlaneFit::rms() const {
  return std::sqrt(std::max(0.0, spread[0]));
}

double PlaneFit::curvature() const {
  const double total = spread.sum();
  return total > 0.0 ? std::max(0.0, spread[0]) / total : 0.0;
}

void PointMoments::add(const PointMoments& other) {
  const Eigen::Vector3d shift = other.reference_ - reference_;
  weight_ += other.weight_;
  squares_ += other.squares_ + shift * other.sum_.transpose() + other.sum_ * shift.transpose() +
              other.weight_ * (shift * shift.transpose());
  sum_ += other.sum_ + other.weight_ * shift;
}

Eigen::Vector3d PointMoments::centroid() const {
  return reference_ + sum_ / weight_;
}

Eigen::Matrix3d PointMoments::covariance() const {
  const Eigen::Vector3d mean = sum_ / weight_;
  return squares_ / weight_ - mean * mean.transpose();
}

PlaneFit PointMoments::plane() const {
  const Eigen3 eigen = eigen3(covariance());
  return {centroid(), eigen.vectors.col(0), eigen.values.cwiseMax(0.0)};
}

}  // namespace velum::geometry
