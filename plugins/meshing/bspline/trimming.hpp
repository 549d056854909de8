// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "fitted.hpp"
#include "outline.hpp"

namespace velum::meshing {

/// A border in the unrolled plane.
struct TrimmingCurve {
  Eigen::Matrix2Xd loop;       ///< counter-clockwise, fine
  std::vector<Index> corners;  ///< points of the loop that are corners
  double moved = 0.0;          ///< usual outward move of the edge's points [m]
};

/// The sheet's edge as smooth curves between the corners that the outline shows (tack, clew, and
/// head with its two ends): B-splines through the outermost returns, each moved outward by half a
/// scan step where the cloud knows its lines and beams (a scan ends before the cloth). A return
/// that lies well inside the curve only says that the edge is not farther in, and counts little.
/// Throws Error (Fault::stage) when the outline has no such corners or sides.
[[nodiscard]] TrimmingCurve smooth_border(const Cloud& cloud, const FittedSheet& sheet,
                                          const Eigen::Matrix2Xd& plane,
                                          const PointOutline& outline);

/// The outline itself.
[[nodiscard]] TrimmingCurve plain_border(const Eigen::Matrix2Xd& plane,
                                         const std::vector<std::int32_t>& loop);

}  // namespace velum::meshing
