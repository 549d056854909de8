// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/plane_cells.hpp"

namespace velum::geometry {
namespace {

/// λ0/Σλ up to which a cell may start a plane.
constexpr float kFlat = 0.02F;

/// Planes as lists of cells.
class Growing {
 public:
  Growing(const PlaneCells& cells, double angle)
      : cells_(cells), cosine_(std::cos(angle)), tolerance_(kPlaneTolerance * cells.edge) {
    region_.assign(cells.normals.size(), -1);
  }

  std::vector<std::vector<std::int32_t>> run(std::size_t least, Context& context) {
    std::vector<std::int32_t> seeds(region_.size());
    std::iota(seeds.begin(), seeds.end(), 0);
    std::stable_sort(seeds.begin(), seeds.end(), [&](std::int32_t a, std::int32_t b) {
      return cells_.curvature[static_cast<std::size_t>(a)] <
             cells_.curvature[static_cast<std::size_t>(b)];
    });
    std::vector<std::vector<std::int32_t>> regions;
    for (const std::int32_t seed : seeds) {
      if (cells_.curvature[static_cast<std::size_t>(seed)] > kFlat) break;
      if (region_[static_cast<std::size_t>(seed)] >= 0) continue;
      context.check();
      auto region = grow(seed);
      if (region.size() >= least) {
        ++number_;
        regions.push_back(std::move(region));
      } else {
        // Given back, for a larger plane may still want them.
        for (const std::int32_t c : region) region_[static_cast<std::size_t>(c)] = -1;
      }
    }
    return regions;
  }

 private:
  std::vector<std::int32_t> grow(std::int32_t seed) {
    PointMoments moments(cells_.mean(seed));
    for_each_near(seed, [&](std::int32_t c) { moments.add(cells_.mean(c)); });
    PlaneFit plane = moments.plane();
    moments = PointMoments(cells_.mean(seed));
    std::vector<std::int32_t> region{seed};
    region_[static_cast<std::size_t>(seed)] = number_;
    std::size_t refit = 8;
    for (std::size_t next = 0; next < region.size(); ++next) {
      moments.add(cells_.mean(region[next]));
      if (next == refit) {
        plane = moments.plane();
        refit += refit / 2;
      }
      for_each_near(region[next], [&](std::int32_t c) {
        if (region_[static_cast<std::size_t>(c)] >= 0 || !fits(plane, c)) return;
        region_[static_cast<std::size_t>(c)] = number_;
        region.push_back(c);
      });
    }
    return region;
  }

  template <class Visit>
  void for_each_near(std::int32_t cell, const Visit& visit) const {
    const std::size_t first = static_cast<std::size_t>(cell) * kCellNeighbours;
    for (std::size_t k = first; k < first + kCellNeighbours && cells_.near[k] >= 0; ++k)
      visit(cells_.near[k]);
  }

  [[nodiscard]] bool fits(const PlaneFit& plane, std::int32_t cell) const {
    const auto at = static_cast<std::size_t>(cell);
    return std::abs(plane.distance(cells_.mean(cell))) < tolerance_ &&
           std::abs(plane.normal.dot(cells_.normals[at].cast<double>())) > cosine_;
  }

  const PlaneCells& cells_;
  double cosine_;
  double tolerance_;
  std::vector<std::int32_t> region_;
  std::int32_t number_ = 0;
};

}  // namespace

PlaneCells make_plane_cells(Points means, double edge, Context& context) {
  PlaneCells cells{Cloud(std::move(means)), edge, {}, {}, {}};
  const auto n = static_cast<std::size_t>(cells.cloud.size());
  cells.near.assign(n * kCellNeighbours, -1);
  cells.normals.assign(n, Eigen::Vector3f::Zero());
  cells.curvature.assign(n, 1.0F);
  const auto reach = static_cast<float>(9.0 * edge * edge);
  const auto visit = [&](Index query, std::span<const Neighbour> found) {
    const auto c = static_cast<std::size_t>(query);
    PointMoments moments(cells.mean(static_cast<std::int32_t>(query)));
    std::size_t used = 0;
    for (const Neighbour& neighbour : found) {
      if (neighbour.distance2 > reach) break;
      cells.near[c * kCellNeighbours + used++] = neighbour.index;
      moments.add(cells.mean(neighbour.index));
    }
    if (used < 5) return;
    const PlaneFit fit = moments.plane();
    cells.normals[c] = fit.normal.cast<float>();
    cells.curvature[c] = static_cast<float>(fit.curvature());
  };
  cells.cloud.neighbours().each_nearest(kCellNeighbours, context, visit);
  return cells;
}

std::vector<std::vector<std::int32_t>> grow_planes(const PlaneCells& cells, double angle,
                                                   std::size_t least, Context& context) {
  return Growing(cells, angle).run(least, context);
}

}  // namespace velum::geometry
