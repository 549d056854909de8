// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "projection.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace velum::meshing {

Eigen::Matrix2Xd project_best_fit(const ConstPoints& positions) {
  if (positions.cols() == 0) return {};
  const Eigen::Vector3d centre = positions.cast<double>().rowwise().mean();
  const Eigen::Matrix3Xd offsets = positions.cast<double>().colwise() - centre;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(offsets * offsets.transpose());
  // The two axes of largest spread span the plane.
  return axes.eigenvectors().rightCols<2>().transpose() * offsets;
}

Eigen::Matrix2Xd project_spherical(const ConstPoints& positions, const Eigen::Vector3f& sensor) {
  if (positions.cols() == 0) return {};
  const Eigen::Matrix3Xd rays = positions.cast<double>().colwise() - sensor.cast<double>();
  const Eigen::Vector3d middle = rays.rowwise().mean();
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(middle, Eigen::Vector3d::UnitX());
  const Eigen::Matrix3Xd turned = turn.toRotationMatrix() * rays;
  Eigen::Matrix2Xd angles(2, rays.cols());
  for (Index i = 0; i < turned.cols(); ++i) {
    const auto ray = turned.col(i);
    angles.col(i) << std::atan2(ray.y(), ray.x()), std::atan2(ray.z(), ray.head<2>().norm());
  }
  return angles;
}

std::optional<std::size_t> main_sensor(const Cloud& cloud) {
  if (cloud.sensors().empty()) return std::nullopt;
  std::vector<Index> seen(cloud.sensors().size(), 0);
  for (Index i = 0; i < cloud.size(); ++i) ++seen.at(*cloud.sensor_of(i));
  return static_cast<std::size_t>(std::max_element(seen.begin(), seen.end()) - seen.begin());
}

}  // namespace velum::meshing
