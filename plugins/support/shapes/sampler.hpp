// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>
#include <velum/random.hpp>
#include <velum/types.hpp>

namespace velum::shapes {

/// Draws points that lie close together: all from one cell of an octree, level 0 the whole cloud.
/// Points are kept in the order of their Morton codes, in which every cell is one stretch.
class LocalSampler {
 public:
  explicit LocalSampler(const Points& positions);

  /// Levels from 0 to the one whose cells hold some ten points of a surface.
  [[nodiscard]] int levels() const { return levels_; }
  /// Points not yet removed, in Morton order.
  [[nodiscard]] const std::vector<std::int32_t>& points() const { return points_; }
  /// Three different points of one cell; nothing when the cell drawn holds fewer.
  [[nodiscard]] std::optional<std::array<std::int32_t, 3>> draw(Random& random, int level) const;
  /// Takes out the points whose entry in `labels` is not -1.
  void remove(const Eigen::VectorXi& labels);

 private:
  std::vector<std::uint64_t> codes_;
  std::vector<std::int32_t> points_;
  int levels_ = 1;
};

}  // namespace velum::shapes
