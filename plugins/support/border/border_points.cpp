// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "border/border_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/eigen3.hpp"
#include "geometry/moments.hpp"

namespace velum::border {
namespace {

// Two rings of an even sheet, and still two rows where a scan's lines are three beams apart.
constexpr Index kAround = 24;
constexpr double kGap = 2.0 * std::numbers::pi / 3.0;

}  // namespace

double largest_gap(const ConstPoints& points, const Eigen::Vector3f& at,
                   const Eigen::Vector3d& normal, std::span<const Neighbour> found) {
  const Eigen::Vector3d x = normal.unitOrthogonal();
  const Eigen::Vector3d y = normal.cross(x);
  thread_local std::vector<double> angles;
  angles.clear();
  for (const Neighbour& n : found) {
    const Eigen::Vector3d d = (points.col(n.index) - at).cast<double>();
    const double u = d.dot(x);
    const double v = d.dot(y);
    if (u != 0.0 || v != 0.0) angles.push_back(std::atan2(v, u));
  }
  if (angles.size() < 2) return 2.0 * std::numbers::pi;
  std::sort(angles.begin(), angles.end());
  double gap = angles.front() + 2.0 * std::numbers::pi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) gap = std::max(gap, angles[i] - angles[i - 1]);
  return gap;
}

std::vector<std::uint8_t> border_points(const Cloud& cloud, Context& context) {
  std::vector<std::uint8_t> border(static_cast<std::size_t>(cloud.size()), 0);
  const ConstPoints positions = cloud.positions();
  cloud.neighbours().each_nearest(
      kAround + 1, context, [&](Index i, std::span<const Neighbour> found) {
        const Eigen::Vector3f at = positions.col(i);
        geometry::NeighbourMoments moments;
        for (const Neighbour& n : found) moments.add(positions.col(n.index) - at);
        const geometry::Eigen3 axes = geometry::eigen3(moments.covariance());
        const double gap = largest_gap(positions, at, axes.vectors.col(0), found);
        border[static_cast<std::size_t>(i)] = gap > kGap ? 1 : 0;
      });
  return border;
}

}  // namespace velum::border
