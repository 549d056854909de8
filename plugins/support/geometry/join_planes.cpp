// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "geometry/plane_cells.hpp"
#include "velum/random.hpp"

namespace velum::geometry {
namespace {

constexpr int kTrials = 64;

PlaneFit through(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  PlaneFit plane;
  plane.centroid = a;
  plane.normal = (b - a).cross(c - a).normalized();
  return plane;
}

PointMoments within(const PlaneCells& cells, const std::vector<std::int32_t>& region,
                    const PlaneFit& plane, double band) {
  PointMoments moments(plane.centroid);
  for (const std::int32_t c : region)
    if (std::abs(plane.distance(cells.mean(c))) < band) moments.add(cells.mean(c));
  return moments;
}

/// The plane that most cells of a region agree on (RANSAC, thesis 3.3.2), then least squares over
/// these.
PlaneFit settle(const PlaneCells& cells, const std::vector<std::int32_t>& region) {
  Random random(region.size());
  const auto any = [&] {
    return cells.mean(
        region[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(region.size())))]);
  };
  const double band = 0.5 * kPlaneTolerance * cells.edge;
  PlaneFit best = within(cells, region, {}, 1e300).plane();
  double most = within(cells, region, best, band).weight();
  for (int trial = 0; trial < kTrials; ++trial) {
    const PlaneFit plane = through(any(), any(), any());
    if (!plane.normal.allFinite()) continue;
    const double agree = within(cells, region, plane, band).weight();
    if (agree > most) {
      most = agree;
      best = plane;
    }
  }
  const PointMoments kept = within(cells, region, best, band);
  return kept.weight() >= 3.0 ? kept.plane() : best;
}

bool same_plane(const GrownPlane& large, const GrownPlane& small, double tolerance) {
  return std::abs(large.fit.normal.dot(small.fit.normal)) > std::cos(0.07) &&
         std::abs(large.fit.distance(small.fit.centroid)) < tolerance;
}

}  // namespace

std::vector<GrownPlane> join_planes(const PlaneCells& cells,
                                    std::vector<std::vector<std::int32_t>> regions) {
  std::stable_sort(regions.begin(), regions.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  std::vector<GrownPlane> joined;
  for (auto& region : regions) {
    GrownPlane part{settle(cells, region), std::move(region)};
    const auto whole = std::find_if(joined.begin(), joined.end(), [&](const GrownPlane& one) {
      return same_plane(one, part, kPlaneTolerance * cells.edge);
    });
    if (whole == joined.end()) {
      joined.push_back(std::move(part));
    } else {
      whole->cells.insert(whole->cells.end(), part.cells.begin(), part.cells.end());
      whole->fit = settle(cells, whole->cells);
    }
  }
  std::stable_sort(joined.begin(), joined.end(), [](const GrownPlane& a, const GrownPlane& b) {
    return a.cells.size() > b.cells.size();
  });
  return joined;
}

}  // namespace velum::geometry
