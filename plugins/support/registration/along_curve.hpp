// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "velum/types.hpp"

namespace velum::registration {

/// Indices of the points along a Morton curve through their bounding box, so that what comes one
/// after the other lies together: work in this order finds what it needs in the cache, whatever
/// order the points came in. Points of one cell (a 1024th of the longest edge) keep theirs.
std::vector<std::int32_t> along_curve(const Eigen::Ref<const Points>& positions);

}  // namespace velum::registration
