// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "fitted.hpp"
#include "outline.hpp"
#include "sail/border.hpp"

namespace velum::meshing {

/// The edge's points next to the outline, in the unrolled plane (x, 0, y): each half a scan step
/// beyond a last return, measured on the fitted surface, where noise along the rays does not
/// matter. Their places along the outline are not set. The cloud must have beams and lines
/// (sail::is_scan).
[[nodiscard]] sail::EdgePoints scan_edge(const Cloud& cloud, const FittedSheet& sheet,
                                         const PointOutline& outline,
                                         const Eigen::Matrix2Xd& plane);

}  // namespace velum::meshing
