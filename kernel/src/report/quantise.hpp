// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "report/view.hpp"

namespace velum::report {

/// Positions in 65535 steps of their bounding box on each axis: off by at most half a step.
void quantise_positions(const Cloud& cloud, View& view);

/// The column as the page shows it; nothing for what it does not show: columns wider than one
/// scalar, and the scanner's bookkeeping.
[[nodiscard]] std::optional<ViewColumn> quantise(const std::string& name, const Column& column);
/// Integers, of which negative ones mean none.
[[nodiscard]] ViewColumn labels(const std::string& name, const std::vector<std::int64_t>& numbers);

/// What stages mean by the names of columns, which carry no units: "m" of "distance"; "" where it
/// is not known.
[[nodiscard]] std::string unit_of(std::string_view column);

/// The elements of a column of width 1 as numbers.
[[nodiscard]] std::vector<double> numbers_of(const Column& column);

}  // namespace velum::report
