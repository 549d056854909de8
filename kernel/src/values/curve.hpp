// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "velum/types.hpp"

namespace velum::spatial {

/// Indices of the positions in the order in which a Hilbert curve meets them, so that what is near
/// in the order is near in space. Where more than `run` points fall into one cell of the curve,
/// they are ordered by a finer curve of their own: any density and any stray point is met.
std::vector<std::int32_t> curve_order(const ConstPoints& positions, std::size_t run);

}  // namespace velum::spatial
