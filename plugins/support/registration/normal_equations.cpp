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

void NormalEquations::add(const Matrix6& matrix, const Vector6& right, double squares,
                          double weight) {
  matrix_ += matrix;
  right_ += right;
  squares_ += squares;
  weight_ += weight;
}

void NormalEquations::scale(double times) {
  matrix_ *= times;
  right_ *= times;
  squares_ *= times;
  weight_ *= times;
}

NormalEquations::Directions NormalEquations::directions(double radius) const {
  const Vector6 scale = arc_scale(radius);
  const Matrix6 scaled = scale.asDiagonal() * matrix_ * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(scaled / std::max(weight_, 1e-300));
  return {solver.eigenvalues().cwiseMax(0.0), solver.eigenvectors(), radius};
}

Vector6 NormalEquations::twist(double radius, double cutoff) const {
  const Vector6 scale = arc_scale(radius);
  const Directions found = directions(radius);
  const Vector6 right = found.axes.transpose() * (scale.asDiagonal() * right_) / weight_;
  Vector6 steps = Vector6::Zero();
  for (int k = 0; k < 6; ++k)
    if (found.strength[k] > cutoff) steps[k] = right[k] / found.strength[k];
  return scale.asDiagonal() * (found.axes * steps);
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

Pose euler_motion(const Vector6& twist, const Eigen::Vector3d& centre) {
  Pose pose = Pose::Identity();
  pose.linear() = (Eigen::AngleAxisd(twist[2], Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(twist[1], Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(twist[0], Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();
  pose.translation() = centre + twist.tail<3>() - pose.linear() * centre;
  return pose;
}

std::string describe_direction(const Vector6& axis) {
  const bool turn = axis.head<3>().norm() > axis.tail<3>().norm();
  const Eigen::Vector3d way = (turn ? axis.head<3>() : axis.tail<3>()).normalized();
  return fmt::format("{} ({:.2f}, {:.2f}, {:.2f})", turn ? "turning about" : "sliding along",
                     way.x(), way.y(), way.z());
}

}  // namespace velum::registration
