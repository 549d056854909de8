// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/context.hpp>

namespace velum::meshing {

/// Lays a sheet of points flat, keeping distances along the sheet as far as it can be done: it does
/// not fold where the sheet is twisted or bent past a right angle, as a projection would.
/// Distances are shortest ways through the graph of ten nearest neighbours; places in the plane
/// come from up to 120 landmarks (Tenenbaum, de Silva and Langford, A global geometric framework
/// for nonlinear dimensionality reduction, 2000; de Silva and Tenenbaum, Sparse multidimensional
/// scaling using landmark points, 2004). Throws Error (Fault::stage) for fewer than four points,
/// and when all lie on a line.
[[nodiscard]] Eigen::Matrix2Xd unroll(const Points& points, Context& context);

}  // namespace velum::meshing
