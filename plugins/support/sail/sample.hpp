// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/values.hpp>

namespace velum::sail {

/// A fine mesh of a surface: 160 × 240 cells over its knots' range. A trimmed one keeps the cells
/// inside its outer loop, with the corners that stick out drawn to the loop. Throws Error
/// (Fault::stage) when knots, control points or weights do not fit together.
[[nodiscard]] Mesh sample(const Surface& surface);

}  // namespace velum::sail
