// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bspline/refine.hpp"
#include "fitted.hpp"

namespace velum::meshing {

/// Middles of the spans in which the residuals of neighbouring points agree too well to be noise.
/// In each span the residuals are summed over cells of half a span by half a span: sums of noise
/// have the variance of noise, so that their squares, so scaled, are 1 on average. What is left of
/// shape must also be seen beside the noise, for knots cost stability.
[[nodiscard]] std::vector<double> spans_to_halve(const FittedSheet& sheet,
                                                 const Eigen::VectorXd& weights,
                                                 bspline::Along along);

}  // namespace velum::meshing
