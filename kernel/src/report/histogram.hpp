// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "report/view.hpp"
#include "velum/context.hpp"

namespace velum::report {

inline constexpr std::size_t kBins = 64;

/// Of the finite ones among the numbers, each counted once. The bins cover all of them or, where a
/// few lie far off, the range without the lowest and highest 0.5 %; `lowest` and `highest` are the
/// ends of that range where they are given.
[[nodiscard]] Histogram histogram(std::string name, std::string unit,
                                  const std::vector<double>& numbers);
/// The same over a given range.
[[nodiscard]] Histogram histogram(std::string name, std::string unit,
                                  const std::vector<double>& numbers, double lo, double hi);

/// The angles [deg] and edge ratios (longest to shortest) of a mesh's triangles but degenerate
/// ones, as analysis.mesh_quality measures them.
[[nodiscard]] std::vector<Histogram> triangle_histograms(const Mesh& mesh);

/// Distance of points of `cloud` to the nearest one of `target` [m]: of all of them, or of
/// kMostDistances and fewer that are evenly chosen.
[[nodiscard]] Histogram distances(std::string name, const Cloud& cloud, const Cloud& target,
                                  Context& context);

/// Points that lie far from the target take long to measure; more would not show.
inline constexpr Index kMostDistances = 30'000;

}  // namespace velum::report
