// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "geometry/selection.hpp"

#include <algorithm>

namespace velum::geometry {

Cloud keep_points(const Cloud& cloud, const std::vector<std::uint8_t>& keep, Context& context) {
  const auto count = static_cast<std::size_t>(
      std::count_if(keep.begin(), keep.end(), [](std::uint8_t one) { return one != 0; }));
  // Each index is written and stays where its point is kept: no branch to be mispredicted. The one
  // more is for what is written after the last.
  std::vector<std::int32_t> kept(count + 1);
  std::size_t at = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    kept[at] = static_cast<std::int32_t>(i);
    at += keep[i] != 0 ? 1 : 0;
  }
  kept.resize(count);
  context.measure("removed", static_cast<double>(keep.size() - kept.size()), "");
  context.measure("kept", static_cast<double>(kept.size()), "");
  return kept.size() == keep.size() ? cloud : cloud.select(kept);
}

}  // namespace velum::geometry
