// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>
#include <velum/cloud.hpp>
#include <velum/context.hpp>

namespace velum::geometry {

/// The points whose entry in `keep` is not zero, in their order and with all their columns. Records
/// the measures `removed` and `kept`. The cloud itself, sharing everything, when all are kept.
Cloud keep_points(const Cloud& cloud, const std::vector<std::uint8_t>& keep, Context& context);

}  // namespace velum::geometry
