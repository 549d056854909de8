// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace velum::cgal {

/// Triangles (counter-clockwise, smallest index first, in ascending order) of the constrained
/// Delaunay triangulation of the columns of `points` that lie inside the closed polygons `loops`
/// by the even-odd rule. Edges of the polygons are edges of triangles. Of points that coincide only
/// the first is used. Throws velum::Error (Fault::stage) when polygons cross themselves or each
/// other.
std::vector<std::array<std::int32_t, 3>> constrained_delaunay_2(
    const Eigen::Matrix2Xd& points, const std::vector<std::vector<std::int32_t>>& loops);

}  // namespace velum::cgal
