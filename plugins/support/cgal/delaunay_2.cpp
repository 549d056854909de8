// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "cgal/delaunay_2.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>

namespace velum::cgal {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
using Triangulation =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;

// CGAL keeps the last of coinciding points in a bulk insertion; which one it is must not depend on
// it.
std::vector<std::pair<Kernel::Point_2, std::int32_t>> distinct(const Eigen::Matrix2Xd& points) {
  std::vector<std::int32_t> order(static_cast<std::size_t>(points.cols()));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::int32_t>(i);
  const auto key = [&](std::int32_t i) { return std::tuple(points(0, i), points(1, i), i); };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
  const auto same = [&](auto a, auto b) { return points.col(a) == points.col(b); };
  order.erase(std::unique(order.begin(), order.end(), same), order.end());
  std::vector<std::pair<Kernel::Point_2, std::int32_t>> found;
  found.reserve(order.size());
  for (const std::int32_t i : order)
    found.emplace_back(Kernel::Point_2(points(0, i), points(1, i)), i);
  return found;
}

}  // namespace

std::vector<std::array<std::int32_t, 3>> delaunay_2(const Eigen::Matrix2Xd& points) {
  const auto input = distinct(points);
  Triangulation triangulation;
  triangulation.insert(input.begin(), input.end());
  std::vector<std::array<std::int32_t, 3>> triangles;
  triangles.reserve(triangulation.number_of_faces());
  for (const auto& face : triangulation.finite_face_handles()) {
    std::array<std::int32_t, 3> t{face->vertex(0)->info(), face->vertex(1)->info(),
                                  face->vertex(2)->info()};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.push_back(t);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace velum::cgal
