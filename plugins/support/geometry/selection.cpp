// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "geometry/selection.hpp"

namespace velum::geometry {

Cloud keep_points(const Cloud& cloud, const std::vector<std::uint8_t>& keep, Context& context) {
  std::vector<std::int32_t> kept;
  kept.reserve(keep.size());
  for (std::size_t i = 0; i < keep.size(); ++i)
    if (keep[i] != 0) kept.push_back(static_cast<std::int32_t>(i));
  context.measure("removed", static_cast<double>(keep.size() - kept.size()), "");
  context.measure("kept", static_cast<double>(kept.size()), "");
  return kept.size() == keep.size() ? cloud : cloud.select(kept);
}

}  // namespace velum::geometry
