// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "velum/types.hpp"

namespace velum::geometry {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// The rigid motion reached by moving for unit time with angular velocity twist[0..2] [rad] and, at
/// `centre`, velocity twist[3..5] [m]: a helical motion (exponential map), exact for any angle.
Pose exponential(const Vector6& twist, const Eigen::Vector3d& centre = Eigen::Vector3d::Zero());

/// Angle of a rotation [rad], 0 to π, accurate for small ones.
double angle_of(const Eigen::Matrix3d& rotation);

/// How two poses differ: the angle between their rotations [rad] and how far apart they carry
/// `point` [m].
struct Difference {
  double rotation;
  double translation;
};
Difference difference(const Pose& a, const Pose& b,
                      const Eigen::Vector3d& point = Eigen::Vector3d::Zero());

/// `local` maps coordinates relative to `source_origin` to coordinates relative to `target_origin`;
/// the same motion of true positions.
Pose to_true(const Pose& local, const Eigen::Vector3d& source_origin,
             const Eigen::Vector3d& target_origin);
/// The inverse of to_true.
Pose to_local(const Pose& motion, const Eigen::Vector3d& source_origin,
              const Eigen::Vector3d& target_origin);

/// The nearest rotation to a matrix that is one but for rounding.
Eigen::Matrix3d orthonormal(const Eigen::Matrix3d& matrix);

}  // namespace velum::geometry
