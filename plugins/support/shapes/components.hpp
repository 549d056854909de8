// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>
#include <velum/context.hpp>
#include <velum/types.hpp>

namespace velum::shapes {

/// Points joined by chains of steps no longer than a radius.
struct Components {
  Eigen::VectorXi labels;    ///< of each point; 0 is the largest, equal ones by their first point
  std::vector<Index> sizes;  ///< descending
};

/// Exactly the components of the graph of all pairs at most `radius` [m] apart, without looking at
/// all pairs: points of one cell whose diagonal is the radius are one component anyway, and two
/// cells are joined by the first pair that is near enough. Time does not grow with the radius.
/// Throws Error when the radius is below 1e-9 of the extent.
Components components(const ConstPoints& positions, double radius, Context& context);

/// Of these points the largest component alone, in their order.
std::vector<std::int32_t> largest_part(const Points& positions,
                                       const std::vector<std::int32_t>& members, double radius,
                                       Context& context);

}  // namespace velum::shapes
