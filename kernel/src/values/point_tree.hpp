// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "values/selection.hpp"
#include "velum/types.hpp"

namespace velum::spatial {

/// Sixteen points in the order of the curve. Places that stay empty hold NaN, whose distance is
/// never within a limit.
struct Leaf {
  static constexpr int kSize = 16;
  Eigen::Array<float, kSize, 3> position;
  std::array<std::int32_t, kSize> index;
};

struct Box {
  Eigen::Array3f low = Eigen::Array3f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Array3f high = -low;
};

/// Eight bounding boxes; those not set are infinitely far away.
struct Boxes {
  static constexpr int kSize = 8;
  Eigen::Array<float, kSize, 3> low =
      Eigen::Array<float, kSize, 3>::Constant(std::numeric_limits<float>::infinity());
  Eigen::Array<float, kSize, 3> high = -low;
  void set(Index i, const Box& box) {
    low.row(i) = box.low;
    high.row(i) = box.high;
  }
};

/// Points in leaves along a Hilbert curve, with a hierarchy of bounding boxes above, eight to a
/// node (a packed R-tree; Kamel and Faloutsos 1993). It has no depth to speak of, adapts to any
/// density, and equal points are nothing special. Built in O(n) apart from very uneven densities.
///
/// Distances are computed in single precision by one formula everywhere. Rounding is monotonic, so
/// the distance to a box is never larger than that to a point in it, and answers are exact.
class PointTree {
 public:
  explicit PointTree(const ConstPoints& positions);

  [[nodiscard]] Index size() const { return size_; }
  [[nodiscard]] const std::vector<Leaf>& leaves() const { return leaves_; }
  /// Points in leaf number `leaf`.
  [[nodiscard]] Index points_in(Index leaf) const {
    return std::min<Index>(Leaf::kSize, size_ - leaf * Leaf::kSize);
  }
  [[nodiscard]] const Box& box(std::int32_t leaf) const {
    return boxes_[static_cast<std::size_t>(leaf)];
  }

  /// A limit to the squared distances of the `k` nearest points (0 < k <= size) that is rarely more
  /// than four times too large: the k-th of those around the place of `leaf`, which is near the
  /// query, on the curve.
  float limit_nearest(const Eigen::Array3f& query, std::size_t k, std::int32_t leaf,
                      Candidates& memory) const;
  /// A leaf near the query, by going down to the nearest box; there is at least one point.
  [[nodiscard]] std::int32_t leaf_near(const Eigen::Array3f& query) const;
  /// At least the `k` nearest points (0 < k <= size), in no order; returns a limit that the squared
  /// distances of the k nearest do not exceed, nor any found.
  float gather_nearest(const Eigen::Array3f& query, std::size_t k, Candidates& out) const;
  /// All points whose squared distance is at most `limit2`, in no order.
  void gather_within(const Eigen::Array3f& query, float limit2, Candidates& out) const;
  /// The nearest point whose squared distance is at most `limit2`; else index -1.
  [[nodiscard]] Neighbour nearest_one(const Eigen::Array3f& query, float limit2) const;
  /// Leaves with a box that is at most sqrt(limit2) from `box`.
  void leaves_near(const Box& box, float limit2, std::vector<std::int32_t>& out) const;

 private:
  /// Boxes of node `number` of `level` that are set.
  [[nodiscard]] std::size_t children_of(std::size_t level, std::size_t number) const;
  template <class OnLeaf>
  void descend(const Box& query, const float& limit2, const OnLeaf& on_leaf) const;

  Index size_;
  std::vector<Leaf> leaves_;
  std::vector<Box> boxes_;                  ///< of the leaves
  std::vector<std::vector<Boxes>> levels_;  ///< nodes over leaves first; the last has one node
};

/// Squared distances from `query` to the points of `leaf`.
inline Eigen::Array<float, Leaf::kSize, 1> distances(const Leaf& leaf,
                                                     const Eigen::Array3f& query) {
  return (leaf.position.col(0) - query.x()).square() + (leaf.position.col(1) - query.y()).square() +
         (leaf.position.col(2) - query.z()).square();
}

/// Squared distances from `query` to the boxes; 0 where they overlap.
inline Eigen::Array<float, Boxes::kSize, 1> distances(const Boxes& boxes, const Box& query) {
  const auto gap = [&](int axis) {
    return (boxes.low.col(axis) - query.high(axis))
        .max(query.low(axis) - boxes.high.col(axis))
        .max(0.0F);
  };
  return gap(0).square() + gap(1).square() + gap(2).square();
}

/// Writes the points of `leaf` within the limit to `out`, which has room for a whole leaf; returns
/// the end of what was written. Free of branches that the processor could not foresee.
inline Neighbour* gather(const Leaf& leaf, const Eigen::Array3f& query, float limit2,
                         Neighbour* out) {
  const auto distance2 = distances(leaf, query);
  for (int i = 0; i < Leaf::kSize; ++i) {
    *out = {leaf.index[static_cast<std::size_t>(i)], distance2(i)};
    out += distance2(i) <= limit2 ? 1 : 0;
  }
  return out;
}

}  // namespace velum::spatial
