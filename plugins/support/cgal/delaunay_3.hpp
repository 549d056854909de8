// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

/// The Delaunay triangulation of points in space, by CGAL with exact predicates.
namespace velum::cgal {

/// Tetrahedra, or triangles where all points lie in one plane; nothing where they lie on a line.
/// Of points that coincide only the first is used.
struct Delaunay3 {
  std::vector<std::array<std::int32_t, 4>> cells;
  /// The cell across the face opposite to corner i; -1: none, the face is of the convex hull.
  std::vector<std::array<std::int32_t, 4>> across;
  /// Of points in one plane; cells is empty then.
  std::vector<std::array<std::int32_t, 3>> flat;
};

Delaunay3 delaunay_3(const Eigen::Matrix3Xd& points);

}  // namespace velum::cgal
