// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bspline/evaluate.hpp"
#include "sail/corners.hpp"

/// The border of a sail that is a surface.
namespace velum::sail {

/// The trimming loops, or the rectangle of the parameters.
[[nodiscard]] std::vector<Eigen::Matrix2Xd> loops_of(const bspline::Patch& patch);

/// A closed loop with points about evenly along the curve on the surface, and so dense that
/// straight lines between them are that curve to some millionths of its length. Points that
/// coincide on the surface, as at a pole, become one. Throws Error (Fault::stage) when it encloses
/// nothing.
[[nodiscard]] Eigen::Matrix2Xd refined(const bspline::Patch& patch, const Eigen::Matrix2Xd& loop);

/// A scan's corner is where two lines fit best; that of a smooth border is the very point where it
/// turns. The outline with its corners there, tack first.
[[nodiscard]] Outline sharpened(const Outline& outline);

}  // namespace velum::sail
