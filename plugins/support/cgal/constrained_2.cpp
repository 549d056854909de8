// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "cgal/constrained_2.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <map>
#include <velum/error.hpp>

namespace velum::cgal {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
// How many polygons lie about a face, -1 while it is not known.
using Face =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<Vertex, Face>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure,
                                               CGAL::No_constraint_intersection_tag>;

// Vertex handles of all points, inserted in the order of their coordinates.
std::vector<Triangulation::Vertex_handle> insert_points(Triangulation& triangulation,
                                                        const Eigen::Matrix2Xd& points) {
  std::vector<std::int32_t> order(static_cast<std::size_t>(points.cols()));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::int32_t>(i);
  const auto key = [&](std::int32_t i) { return std::tuple(points(0, i), points(1, i), i); };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
  std::vector<Triangulation::Vertex_handle> handles(order.size());
  Triangulation::Face_handle hint;
  std::int32_t last = -1;
  for (const std::int32_t i : order) {
    auto& handle = handles[static_cast<std::size_t>(i)];
    if (last >= 0 && points.col(last) == points.col(i)) {
      handle = handles[static_cast<std::size_t>(last)];
    } else {
      handle = triangulation.insert(Kernel::Point_2(points(0, i), points(1, i)), hint);
      handle->info() = i;
      last = i;
    }
    hint = handle->face();
  }
  return handles;
}

void insert_loops(Triangulation& triangulation,
                  const std::vector<Triangulation::Vertex_handle>& handles,
                  const std::vector<std::vector<std::int32_t>>& loops) {
  try {
    for (const auto& loop : loops)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const auto a = handles.at(static_cast<std::size_t>(loop[i]));
        const auto b = handles.at(static_cast<std::size_t>(loop[(i + 1) % loop.size()]));
        if (a != b) triangulation.insert_constraint(a, b);
      }
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    throw Error(Fault::stage, "trimming loops cross themselves or each other")
        .hint("a border that crosses itself encloses no surface");
  }
}

// Counts for every face the polygons about it, inward from outside the convex hull.
void count_loops(Triangulation& triangulation) {
  for (const auto face : triangulation.all_face_handles()) face->info() = -1;
  std::vector<Triangulation::Face_handle> layer{triangulation.infinite_face()};
  for (int depth = 0; !layer.empty(); ++depth) {
    std::vector<Triangulation::Face_handle> beyond;
    while (!layer.empty()) {
      const auto face = layer.back();
      layer.pop_back();
      if (face->info() >= 0) continue;
      face->info() = depth;
      for (int k = 0; k < 3; ++k) {
        const auto next = face->neighbor(k);
        if (next->info() >= 0) continue;
        (face->is_constrained(k) ? beyond : layer).push_back(next);
      }
    }
    layer = std::move(beyond);
  }
}

}  // namespace

std::vector<std::array<std::int32_t, 3>> constrained_delaunay_2(
    const Eigen::Matrix2Xd& points, const std::vector<std::vector<std::int32_t>>& loops) {
  Triangulation triangulation;
  const auto handles = insert_points(triangulation, points);
  insert_loops(triangulation, handles, loops);
  std::vector<std::array<std::int32_t, 3>> triangles;
  if (triangulation.dimension() < 2) return triangles;
  count_loops(triangulation);
  for (const auto face : triangulation.finite_face_handles()) {
    if (face->info() % 2 == 0) continue;
    std::array<std::int32_t, 3> t{face->vertex(0)->info(), face->vertex(1)->info(),
                                  face->vertex(2)->info()};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.push_back(t);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace velum::cgal
