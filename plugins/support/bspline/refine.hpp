// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bspline/evaluate.hpp"

namespace velum::bspline {

enum class Along { u, v };

/// The same surface with one more knot at `at`, inside its range (Boehm, Inserting new knots into
/// B-spline curves, 1980). Weights are kept apart: for surfaces without weights only.
void insert_knot(Surface& surface, Along along, double at);

}  // namespace velum::bspline
