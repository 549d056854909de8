// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/view.hpp"

namespace velum::report {

/// Views of many values, never more than a limit of bytes: those of the most points are thinned, by
/// halves. Arrays of the same content count, and are kept, once; views that shared their positions
/// go on sharing them. What is kept does not depend on the order in which views come: which views
/// are thinned next follows from numbers of points alone.
class Views {
 public:
  explicit Views(std::uint64_t limit) : limit_(limit) {}

  /// Takes the place of a view of the same id.
  void add(View view);
  void limit_to(std::uint64_t bytes);
  [[nodiscard]] const std::vector<View>& all() const { return views_; }
  /// Of all arrays.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  void keep_limit();
  bool thin_largest();

  std::uint64_t limit_;
  std::vector<View> views_;  ///< by order and id
};

/// Halves the longest tables until all of them together have so many cells.
void limit_tables(std::vector<View>& views, std::size_t cells);

/// Views as the page reads them: `values` and `histograms` for its JSON, and the arrays, each at a
/// multiple of 4 bytes.
struct Packed {
  run::Json values = run::Json::array();
  run::Json histograms = run::Json::array();
  std::vector<std::byte> block;
};
[[nodiscard]] Packed pack(const std::vector<View>& views);
/// Back again. Throws Error (Fault::input) when they do not fit together.
[[nodiscard]] std::vector<View> unpack(const run::Json& values, const run::Json& histograms,
                                       std::span<const std::byte> block);

}  // namespace velum::report
