// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "cgal/advancing_front.hpp"

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <velum/random.hpp>

#include "cgal/distinct.hpp"

namespace velum::cgal {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// A number that belongs to the place, the same in every run.
std::uint64_t hash_of(const Kernel::Point_3& p) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis)
    hash = Random(hash ^ std::bit_cast<std::uint64_t>(p[axis])).next();
  return hash;
}

/// The priority of a triangle: its radius, and none where an edge is too long. Among triangles of
/// one size, as a grid has them, CGAL takes the one that lies first in memory; a share of up to a
/// millionth that belongs to the triangle makes that choice the same in every run.
struct ShortEdges {
  double max_edge2;

  template <class Front, class Cell>
  double operator()(const Front& front, Cell& cell, const int& index) const {
    const auto corner = [&](int i) { return cell->vertex((index + i) & 3)->point(); };
    std::uint64_t hash = 0;
    for (int i = 1; i < 4; ++i) {
      if (max_edge2 > 0.0 && CGAL::squared_distance(corner(i), corner(i % 3 + 1)) > max_edge2)
        return std::numeric_limits<double>::infinity();
      hash += hash_of(corner(i));
    }
    constexpr double kMost = 1e-6;
    return front.smallest_radius_delaunay_sphere(cell, index) *
           (1.0 + kMost * Random(hash).uniform());
  }
};

/// CGAL says so on the console.
bool on_a_line(const std::vector<Kernel::Point_3>& points) {
  return points.size() < 3 || std::all_of(points.begin() + 2, points.end(), [&](const auto& p) {
           return CGAL::collinear(points[0], points[1], p);
         });
}

}  // namespace

std::vector<std::array<std::int32_t, 3>> advancing_front(const Eigen::Matrix3Xd& points,
                                                         const FrontRules& rules) {
  const std::vector<std::int32_t> order = distinct(points);
  std::vector<Kernel::Point_3> input;
  for (const std::int32_t i : order) input.emplace_back(points(0, i), points(1, i), points(2, i));
  if (on_a_line(input)) return {};
  std::vector<std::array<std::size_t, 3>> faces;
  CGAL::advancing_front_surface_reconstruction(
      input.begin(), input.end(), std::back_inserter(faces),
      ShortEdges{rules.max_edge * rules.max_edge}, rules.radius_ratio, rules.beta);
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const auto& face : faces) {
    std::array<std::int32_t, 3> t{order[face[0]], order[face[1]], order[face[2]]};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.push_back(t);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace velum::cgal
