// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "study/outcome.hpp"
#include "study/plan.hpp"
#include "study/statistics.hpp"

namespace velum::study {

/// Outcomes by variant and repeat.
using Outcomes = std::map<std::pair<std::size_t, std::size_t>, Outcome>;

/// How a measure of a variant differs from that of its reference, repeat by repeat.
struct Difference {
  std::size_t reference = 0;  ///< index of the variant
  std::size_t pairs = 0;      ///< repeats in which both are ok
  double mean = 0.0;          ///< variant minus reference
  /// Of the exact test, Holm's correction over all variants of the measure; nothing with fewer than
  /// kFewestForAClaim pairs.
  std::optional<double> p;
};

struct MeasureSummary {
  std::size_t count = 0;  ///< repeats that are ok and have it
  Summary summary;
  /// Among the variants of the same source that are ok in every repeat; nothing for others, and for
  /// measures of which neither direction is the better.
  std::optional<int> rank;
  std::optional<Difference> difference;
};

struct VariantSummary {
  Status status = Status::ok;  ///< the first that is not ok
  std::string message;
  double success = 0.0;   ///< share of repeats that are ok
  std::size_t group = 0;  ///< variants of one group had the same data
  std::map<std::string, MeasureSummary> measures;
};

struct Comparison {
  std::map<std::string, Figure> measures;  ///< unit and direction; the value means nothing
  std::vector<std::string> missing;        ///< measures that no cell has
  std::vector<VariantSummary> variants;    ///< as in the plan
  std::size_t groups = 0;
};

/// All that is said of a study's outcomes, of which there is one for each cell.
[[nodiscard]] Comparison compare(const Plan& plan, const Outcomes& outcomes);

}  // namespace velum::study
