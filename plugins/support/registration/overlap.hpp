// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "velum/cloud.hpp"
#include "velum/context.hpp"

namespace velum::registration {

/// Points of `cloud`, brought to the other's frame by `pose` (relative to their origins), that have
/// a point of `other` within `radius` [m]: the cross-cloud filter of thesis 3.2.3 (Algorithm 3.2,
/// 8a). Ascending indices.
std::vector<std::int32_t> overlapping(const Cloud& cloud, const Cloud& other, const Pose& pose,
                                      double radius, Context& context);

}  // namespace velum::registration
