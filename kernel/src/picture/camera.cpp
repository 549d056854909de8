// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "picture/camera.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace velum::picture {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kAzimuth = -60.0 * kDegree;  // where nothing says a better one
constexpr double kElevation = 32.0 * kDegree;
/// A little off the straight view, so that depth shows.
constexpr double kAside = 18.0 * kDegree;
constexpr double kRaised = 14.0 * kDegree;
/// Share of positions that may lie outside of the picture on each side.
constexpr double kStray = 0.002;

/// At most so many positions decide where the camera stands.
constexpr Index kMostLooked = 50'000;

Eigen::Matrix3Xd some(const ConstPoints& positions) {
  const Index step = std::max<Index>(1, positions.cols() / kMostLooked);
  Eigen::Matrix3Xd chosen(3, (positions.cols() + step - 1) / step);
  for (Index i = 0; i < chosen.cols(); ++i) chosen.col(i) = positions.col(i * step).cast<double>();
  return chosen;
}

Vector3d direction(double azimuth, double elevation) {
  return {std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
          std::sin(elevation)};
}

/// Towards the mean of the eyes, where they stand outside of a box around the positions.
std::optional<Vector3d> from_eyes(const Eigen::Matrix3Xd& points,
                                  const std::vector<Vector3f>& eyes) {
  if (eyes.empty()) return std::nullopt;
  const Vector3d low = points.rowwise().minCoeff();
  const Vector3d high = points.rowwise().maxCoeff();
  Vector3d mean = Vector3d::Zero();
  for (const Vector3f& eye : eyes) {
    const Vector3d at = eye.cast<double>();
    if (((at - low).array() >= 0.0).all() && ((high - at).array() >= 0.0).all())
      return std::nullopt;
    mean += at / static_cast<double>(eyes.size());
  }
  const Vector3d towards = mean - 0.5 * (low + high);
  if (towards.head<2>().norm() < 0.2 * towards.norm()) return std::nullopt;
  return direction(std::atan2(towards.y(), towards.x()) + kAside, kRaised);
}

/// Onto the broad side of what is flat and stands upright.
std::optional<Vector3d> from_shape(const Eigen::Matrix3Xd& points) {
  const Vector3d mean = points.rowwise().mean();
  const Eigen::Matrix3Xd centred = points.colwise() - mean;
  const Eigen::Matrix3d covariance = centred * centred.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Vector3d& spread = solver.eigenvalues();
  Vector3d normal = solver.eigenvectors().col(0);
  if (spread[0] > 0.25 * spread[1] || normal.head<2>().norm() < 0.5) return std::nullopt;
  // Both sides are as good: the one nearer to the usual view.
  if (normal.dot(direction(kAzimuth, 0.0)) < 0.0) normal = -normal;
  return direction(std::atan2(normal.y(), normal.x()) + kAside, kRaised);
}

/// The range of a row of coordinates without strays.
std::pair<double, double> range_of(Eigen::RowVectorXd row) {
  const auto count = static_cast<double>(row.size());
  const auto first = static_cast<Index>(kStray * count);
  std::nth_element(row.data(), row.data() + first, row.data() + row.size());
  const double low = row[first];
  const Index last = row.size() - 1 - first;
  std::nth_element(row.data(), row.data() + last, row.data() + row.size());
  return {low, row[last]};
}

}  // namespace

Camera look_at(const ConstPoints& positions, const std::vector<Vector3f>& eyes, int width,
               int height) {
  Camera camera;
  if (positions.cols() == 0) return camera;
  const Eigen::Matrix3Xd points = some(positions);
  auto towards = from_eyes(points, eyes);
  if (!towards && positions.cols() > 3) towards = from_shape(points);
  const Vector3d viewer = towards.value_or(direction(kAzimuth, kElevation));
  const Vector3d right = Vector3d::UnitZ().cross(viewer).normalized();
  Eigen::Matrix3d axes;
  axes << right.transpose(), viewer.cross(right).transpose(), viewer.transpose();
  camera.axes = axes.cast<float>();
  const Eigen::Matrix3Xd seen = axes * points;
  const auto [left, far_right] = range_of(seen.row(0));
  const auto [low, high] = range_of(seen.row(1));
  camera.middle = Eigen::Vector2d(0.5 * (left + far_right), 0.5 * (low + high)).cast<float>();
  constexpr double kMargin = 1.06;
  const double needed =
      std::max((far_right - left) * kMargin / width, (high - low) * kMargin / height);
  constexpr double kFinest = 1e-12;  // [m] of a pixel
  camera.pixels = needed > kFinest ? static_cast<float>(1.0 / needed) : 1.0F;
  return camera;
}

}  // namespace velum::picture
