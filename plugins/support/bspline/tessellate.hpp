// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/context.hpp>
#include <velum/values.hpp>

namespace velum::bspline {

struct Tessellation {
  Mesh mesh;
  Eigen::Matrix2Xd parameters;  ///< (u, v) of each vertex
};

/// Triangles of a surface with edges of about `size` [m], counter-clockwise in (u, v). The border
/// has all the points of the trimming loops, and more where they are farther than `size` apart;
/// points that fall on one place (at a pole) become one vertex. All vertices lie on the surface.
/// Constrained Delaunay in a plane where distances along u, and along the middle in v, are those on
/// the surface. Throws Error (Fault::stage) when the surface is not sound, when a loop leaves its
/// range or crosses another, and when more than four million vertices would be needed.
[[nodiscard]] Tessellation tessellate(const Surface& surface, double size, Context& context);

/// A loop in (u, v) without the points that move the curve on the surface by less than `tolerance`
/// [m] (Douglas and Peucker, 1973); indices into `keep` stay. Never fewer than three points.
[[nodiscard]] Eigen::Matrix2Xd simplified(const Surface& surface, const Eigen::Matrix2Xd& loop,
                                          double tolerance, const std::vector<Index>& keep = {});

}  // namespace velum::bspline
