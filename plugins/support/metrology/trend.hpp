// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

namespace velum::metrology {

/// Does a quantity change with time? A line through the readings by least squares.
struct Trend {
  double slope = 0.0;  ///< in units of the values per unit of the times
  double error = 0.0;  ///< standard error of the slope
  double p = 1.0;      ///< chance of a slope as steep where there is none (Student's t, two-sided)
};
/// `times` and `values` are of equal length. Fewer than three readings, or readings at one time
/// only, have no trend: slope 0, p 1.
[[nodiscard]] Trend trend(std::span<const double> times, std::span<const double> values);

}  // namespace velum::metrology
