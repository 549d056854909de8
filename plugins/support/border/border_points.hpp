// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>
#include <velum/cloud.hpp>
#include <velum/context.hpp>

namespace velum::border {

/// The largest angle [rad] without a neighbour, seen from `at` in the plane square to `normal`; 2π
/// for fewer than two neighbours. Neighbours at the place itself do not count.
double largest_gap(const ConstPoints& points, const Eigen::Vector3f& at,
                   const Eigen::Vector3d& normal, std::span<const Neighbour> found);

/// 1 for points of an open sheet at its border or at the rim of a hole: those around which the
/// nearest neighbours leave a third of the turn empty.
std::vector<std::uint8_t> border_points(const Cloud& cloud, Context& context);

}  // namespace velum::border
