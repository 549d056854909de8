// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "velum/types.hpp"

namespace velum::geometry {

/// The rigid motion that carries `source` onto `target` best.
struct RigidFit {
  Pose pose = Pose::Identity();
  /// Mean squares of the source points along their principal axes [m²], descending. The second one
  /// near 0: the points lie on a line, and the turn about it is free.
  Eigen::Vector3d spread = Eigen::Vector3d::Zero();
  /// RMS of what is left between the pairs [m].
  double rmse = 0.0;
};

/// Least squares over pairs of points, one pair a column (Arun, Huang, Blostein 1987; Umeyama 1991
/// without scale; thesis 3.5 to 3.11). Reflections are excluded; where the points lie on a line or
/// in one place, the smallest of the turns that fit is taken. Weights are 1 when `weights` is
/// empty. Needs at least one pair of positive weight.
RigidFit rigid_fit(const Eigen::Matrix3Xd& source, const Eigen::Matrix3Xd& target,
                   std::span<const double> weights = {});

/// The rotation R that maximises Σ w target · R source, given C = Σ w source targetᵀ: Procrustes,
/// for directions as well as for points about their centroids.
Eigen::Matrix3d best_rotation(const Eigen::Matrix3d& correlation);

}  // namespace velum::geometry
