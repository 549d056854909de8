// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <velum/cloud.hpp>
#include <velum/random.hpp>

namespace velum::test {

/// A sheet z = x²/(2 bend) of 0.8 × 0.8 m with a point every 20 mm, columns along y, seen from
/// above, with noise along z [m].
inline Cloud bent_sheet(double bend, double noise) {
  constexpr Index kSide = 41;
  Random random(11);
  Points points(3, kSide * kSide);
  for (Index i = 0; i < points.cols(); ++i) {
    const double x = 0.02 * static_cast<double>(i / kSide);
    const double y = 0.02 * static_cast<double>(i % kSide);
    points.col(i) =
        Eigen::Vector3d(x, y, x * x / (2.0 * bend) + noise * random.gaussian()).cast<float>();
  }
  Sensor above;
  above.pose.translation() = Eigen::Vector3d(0.4, 0.4, 5.0);
  return Cloud(std::move(points)).with_sensors({above});
}

/// Root mean square height [m] over the sheet of the points that lie `margin` [m] inside it.
inline double sheet_error(const Cloud& cloud, double bend, double margin) {
  double squares = 0.0, count = 0.0;
  for (Index i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = cloud.positions().col(i).cast<double>();
    if (p.head<2>().minCoeff() < margin || p.head<2>().maxCoeff() > 0.8 - margin) continue;
    const double height = (p.z() - p.x() * p.x() / (2.0 * bend)) / std::hypot(1.0, p.x() / bend);
    squares += height * height;
    count += 1.0;
  }
  return std::sqrt(squares / std::max(count, 1.0));
}

}  // namespace velum::test
