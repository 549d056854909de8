// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "geometry/motion.hpp"

#include <Eigen/SVD>
#include <cmath>

namespace velum::geometry {
namespace {

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

}  // namespace

Pose exponential(const Vector6& twist, const Eigen::Vector3d& centre) {
  const Eigen::Vector3d turn = twist.head<3>();
  const double angle = turn.norm();
  const Eigen::Matrix3d w = skew(turn);
  // (1 - cos a)/a² and (a - sin a)/a³, by their series where the quotients lose digits.
  const bool tiny = angle < 1e-4;
  const double half = std::sin(0.5 * angle);
  const double b = tiny ? 0.5 - angle * angle / 24.0 : 2.0 * half * half / (angle * angle);
  const double c = tiny ? 1.0 / 6.0 - angle * angle / 120.0
                        : (angle - std::sin(angle)) / (angle * angle * angle);
  const double a = tiny ? 1.0 - angle * angle / 6.0 : std::sin(angle) / angle;
  Pose pose = Pose::Identity();
  pose.linear() += a * w + b * w * w;
  const Eigen::Vector3d shift = twist.tail<3>() + (b * w + c * w * w) * twist.tail<3>();
  pose.translation() = centre + shift - pose.linear() * centre;
  return pose;
}

double angle_of(const Eigen::Matrix3d& rotation) {
  const Eigen::Vector3d sine(rotation(2, 1) - rotation(1, 2), rotation(0, 2) - rotation(2, 0),
                             rotation(1, 0) - rotation(0, 1));
  return std::atan2(0.5 * sine.norm(), 0.5 * (rotation.trace() - 1.0));
}

Difference difference(const Pose& a, const Pose& b, const Eigen::Vector3d& point) {
  return {angle_of(a.linear().transpose() * b.linear()), (a * point - b * point).norm()};
}

Pose to_true(const Pose& local, const Eigen::Vector3d& source_origin,
             const Eigen::Vector3d& target_origin) {
  Pose motion = local;
  motion.translation() += target_origin - local.linear() * source_origin;
  return motion;
}

Pose to_local(const Pose& motion, const Eigen::Vector3d& source_origin,
              const Eigen::Vector3d& target_origin) {
  Pose local = motion;
  local.translation() = (motion * source_origin) - target_origin;
  return local;
}

Eigen::Matrix3d orthonormal(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) *= -1.0;
  return u * svd.matrixV().transpose();
}

}  // namespace velum::geometry
