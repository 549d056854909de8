// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

namespace velum::cgal {

/// Columns of `points` by their coordinates, of coinciding ones the first only: CGAL keeps the last
/// of these, and which that is must not depend on it.
inline std::vector<std::int32_t> distinct(const Eigen::Matrix3Xd& points) {
  std::vector<std::int32_t> order(static_cast<std::size_t>(points.cols()));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::int32_t>(i);
  const auto key = [&](std::int32_t i) {
    return std::tuple(points(0, i), points(1, i), points(2, i), i);
  };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
  const auto same = [&](auto a, auto b) { return points.col(a) == points.col(b); };
  order.erase(std::unique(order.begin(), order.end(), same), order.end());
  return order;
}

}  // namespace velum::cgal
