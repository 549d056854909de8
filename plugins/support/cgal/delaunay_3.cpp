// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "cgal/delaunay_3.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>

#include "cgal/distinct.hpp"

namespace velum::cgal {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel>;
using Cell = CGAL::Triangulation_cell_base_with_info_3<std::int32_t, Kernel>;
using Triangulation =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;

std::array<std::int32_t, 3> corners(const Triangulation::Facet& facet) {
  std::array<std::int32_t, 3> t{};
  for (int i = 0; i < 3; ++i)
    t[static_cast<std::size_t>(i)] =
        facet.first->vertex(Triangulation::vertex_triple_index(facet.second, i))->info();
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

}  // namespace

Delaunay3 delaunay_3(const Eigen::Matrix3Xd& points) {
  std::vector<std::pair<Kernel::Point_3, std::int32_t>> input;
  for (const std::int32_t i : distinct(points))
    input.emplace_back(Kernel::Point_3(points(0, i), points(1, i), points(2, i)), i);
  Triangulation triangulation(input.begin(), input.end());

  Delaunay3 result;
  if (triangulation.dimension() == 2) {
    for (const auto& facet : triangulation.finite_facets()) result.flat.push_back(corners(facet));
    std::sort(result.flat.begin(), result.flat.end());
  }
  if (triangulation.dimension() < 3) return result;
  for (const auto& cell : triangulation.all_cell_handles()) cell->info() = -1;
  std::int32_t count = 0;
  for (const auto& cell : triangulation.finite_cell_handles()) cell->info() = count++;
  for (const auto& cell : triangulation.finite_cell_handles()) {
    std::array<std::int32_t, 4> vertices{};
    std::array<std::int32_t, 4> across{};
    for (int i = 0; i < 4; ++i) {
      vertices[static_cast<std::size_t>(i)] = cell->vertex(i)->info();
      across[static_cast<std::size_t>(i)] = cell->neighbor(i)->info();
    }
    result.cells.push_back(vertices);
    result.across.push_back(across);
  }
  return result;
}

}  // namespace velum::cgal
