// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <velum/context.hpp>

namespace velum::meshing {

/// Where a set of points in the plane ends.
struct PointOutline {
  std::vector<std::int32_t> loop;                ///< counter-clockwise
  std::vector<std::vector<std::int32_t>> holes;  ///< around places without points
  std::vector<std::int32_t> near;                ///< points on the loop or next to it, ascending
  Eigen::VectorXd spacing;                       ///< usual distance to the neighbours of each [m]
};

/// The Delaunay triangulation without its long outer edges: from the longest on, edges of more than
/// three spacings give way to the point behind them, as long as one simple loop is left (Duckham et
/// al., Efficient generation of simple polygons for characterizing the shape of a set of points in
/// the plane, 2008). Groups of triangles with circumcircles of more than three spacings that do not
/// touch the loop are holes. Throws Error (Fault::stage) when the points make no triangle.
[[nodiscard]] PointOutline find_outline(const Eigen::Matrix2Xd& plane, Context& context);

}  // namespace velum::meshing
