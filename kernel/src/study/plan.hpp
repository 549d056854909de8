// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "graph/study.hpp"

namespace velum::study {

/// One combination of the study's choices.
struct Variant {
  std::string id;                    ///< "v07"
  std::vector<std::size_t> choices;  ///< one an axis
};

/// One run of one variant.
struct Cell {
  std::size_t variant = 0;
  std::size_t repeat = 0;  ///< from 0
  bool operator==(const Cell&) const = default;
};

/// What a study will run: the product of its axes, zipped ones together, without what it excludes,
/// or a random sample of that.
struct Plan {
  graph::Study study;
  std::vector<Variant> variants;

  [[nodiscard]] const std::string& label(const Variant& variant, std::size_t axis) const {
    return study.axes[axis].choices[variant.choices[axis]].label;
  }
  [[nodiscard]] graph::Variation variation(const Variant& variant) const;
  /// For each variant the index of the one that it is compared with: the reference's labels, all
  /// other axes the same. The number of variants when there is none.
  [[nodiscard]] std::vector<std::size_t> references() const;
  [[nodiscard]] std::size_t cells() const { return variants.size() * study.seeds.size(); }
};

/// Throws Error (Fault::graph) when nothing is left to run, or more than kMostVariants.
[[nodiscard]] Plan make_plan(graph::Study study);
inline constexpr std::size_t kMostVariants = 1'000'000;

}  // namespace velum::study
