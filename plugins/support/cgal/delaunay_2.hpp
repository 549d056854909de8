// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

/// The Delaunay triangulation of points in the plane, by CGAL with exact predicates.
namespace velum::cgal {

/// Triangles (counter-clockwise, smallest index first, in ascending order) over the columns of
/// `points`. Of points that coincide only the first is used; collinear sets give no triangle.
std::vector<std::array<std::int32_t, 3>> delaunay_2(const Eigen::Matrix2Xd& points);

}  // namespace velum::cgal
