// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>

#include "registration/icp.hpp"

namespace velum::registration::test {

inline constexpr double kDegree = std::numbers::pi / 180.0;

/// A closed bumpy surface about 1 m across with its exact normals: no turn leaves it as it is.
inline Cloud bumpy(Index n, std::uint64_t seed, double noise = 0.0) {
  Random random(seed);
  Points points(3, n);
  Points normals(3, n);
  const auto radius = [](const Eigen::Vector3d& u) {
    return 0.5 + 0.12 * u.x() * u.y() + 0.1 * u.z() * u.z() * u.z() + 0.08 * u.x();
  };
  for (Index i = 0; i < n; ++i) {
    Eigen::Vector3d u(random.gaussian(), random.gaussian(), random.gaussian());
    u.normalize();
    const Eigen::Vector3d gradient(0.12 * u.y() + 0.08, 0.12 * u.x(), 0.3 * u.z() * u.z());
    const Eigen::Vector3d along = gradient - gradient.dot(u) * u;
    points.col(i) = ((radius(u) + noise * random.gaussian()) * u).cast<float>();
    normals.col(i) = (u - along / radius(u)).normalized().cast<float>();
  }
  return Cloud(points).with(column::kNormals, Column(normals));
}

/// A level square of side 2 m, normals up.
inline Cloud flat(Index side) {
  Points points(3, side * side);
  for (Index i = 0; i < side * side; ++i)
    points.col(i) << 2.0F * static_cast<float>(i % side) / static_cast<float>(side),
        2.0F * static_cast<float>(i / side) / static_cast<float>(side), 0.0F;
  Points normals = Points::Zero(3, side * side);
  normals.row(2).setOnes();
  return Cloud(points).with(column::kNormals, Column(normals));
}

inline Pose turned(double degrees, const Eigen::Vector3d& shift) {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(degrees * kDegree, Eigen::Vector3d(1, 2, -1).normalized())
                      .toRotationMatrix();
  pose.translation() = shift;
  return pose;
}

inline geometry::Difference error(const IcpResult& result, const Pose& truth) {
  return geometry::difference(result.pose, truth);
}

}  // namespace velum::registration::test
