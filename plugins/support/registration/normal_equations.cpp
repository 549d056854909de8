// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/normal_equations.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace velum::registration {
namespace {

/// Directions weaker than this are free: what is left of them is rounding.
constexpr double kFree = 1e-12;

Vector6 arc_scale(double radius) {
  Vector6 scale = Vector6::Ones();
  scale.head<3>().setConstant(radius > 0.0 ? 1.0 / radius : 1.0);
  return scale;
}

}  // namespace

void NormalEquations::add(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double gap,
                          double weight) {
  Vector6 row;
  row.head<3>() = (point - centre_).cross(normal);
  row.tail<3>() = normal;
  matrix_.noalias() += (weight * row) * row.transpose();
  right_ += (weight * gap) * row;
  squares_ += weight * gap * gap;
  weight_ += weight;
}

void NormalEquations::add(const NormalEquations& other) {
  matrix_ += other.matrix_;
  right_ += other.right_;
  squares_ += other.squares_;
  weight_ += other.weight_;
}

NormalEquations::Directions NormalEquations::directions(double radius) const {
  const Vector6 scale = arc_scale(radius);
  const Matrix6 scaled = scale.asDiagonal() * matrix_ * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(scaled / std::max(weight_, 1e-300));
  return {solver.eigenvalues().cwiseMax(0.0), solver.eigenvectors(), radius};
}

Pose NormalEquations::solve(double radius, double cutoff) const {
  const Vector6 scale = arc_scale(radius);
  const Directions found = directions(radius);
  const Vector6 right = found.axes.transpose() * (scale.asDiagonal() * right_) / weight_;
  Vector6 steps = Vector6::Zero();
  for (int k = 0; k < 6; ++k)
    if (found.strength[k] > cutoff) steps[k] = right[k] / found.strength[k];
  return geometry::exponential(scale.asDiagonal() * (found.axes * steps), centre_);
}

NormalEquations::Deviations NormalEquations::deviations(double radius, double sigma) const {
  const Directions found = directions(radius);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Matrix6 covariance = Matrix6::Zero();
  for (int k = 0; k < 6; ++k) {
    if (found.strength[k] <= kFree) {
      const bool turn = found.axes.col(k).head<3>().norm() > 0.5;
      return {turn ? infinite : 0.0, infinite};
    }
    covariance += found.axes.col(k) * found.axes.col(k).transpose() *
                  (sigma * sigma / (found.strength[k] * weight_));
  }
  const auto largest = [](const Eigen::Matrix3d& block) {
    return std::sqrt(
        std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(block).eigenvalues()[2]));
  };
  return {largest(covariance.topLeftCorner<3, 3>()) / std::max(radius, 1e-300),
          largest(covariance.bottomRightCorner<3, 3>())};
}

std::string describe_direction(const Vector6& axis) {
  const bool turn = axis.head<3>().norm() > axis.tail<3>().norm();
  const Eigen::Vector3d way = (turn ? axis.head<3>() : axis.tail<3>()).normalized();
  return fmt::format("{} ({:.2f}, {:.2f}, {:.2f})", turn ? "turning about" : "sliding along",
                     way.x(), way.y(), way.z());
}

}  // namespace velum::registration
