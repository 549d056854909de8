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

  /// At least the `k` nearest points (k > 0), in no order; returns a limit to their squared
  /// distances that is exceeded by none of the k nearest.
  float gather_nearest(const Eigen::Array3f& query, std::size_t k,
                       std::vector<Neighbour>& out) const;
  /// All points whose squared distance is at most `limit2`, in no order.
  void gather_within(const Eigen::Array3f& query, float limit2, std::vector<Neighbour>& out) const;
  /// The nearest point whose squared distance is at most `limit2`; else index -1.
  [[nodiscard]] Neighbour nearest_one(const Eigen::Array3f& query, float limit2) const;
  /// Leaves with a box that is at most sqrt(limit2) from `box`.
  void leaves_near(const Box& box, float limit2, std::vector<std::int32_t>& out) const;

 private:
  /// Bounding boxes of eight nodes or leaves.
  struct Node {
    static constexpr int kFan = 8;
    Eigen::Array<float, kFan, 3> low;
    Eigen::Array<float, kFan, 3> high;
  };
  template <class OnLeaf>
  void descend(const Box& query, const float& limit2, const OnLeaf& on_leaf) const;
  static Eigen::Array<float, Node::kFan, 1> distances(const Node& node, const Box& query);

  Index size_;
  std::vector<Leaf> leaves_;
  std::vector<Box> boxes_;                 ///< of the leaves
  std::vector<std::vector<Node>> levels_;  ///< nodes over leaves first; the last has one node
};

/// Squared distances from `query` to the points of `leaf`.
inline Eigen::Array<float, Leaf::kSize, 1> distances(const Leaf& leaf,
                                                     const Eigen::Array3f& query) {
  return (leaf.position.col(0) - query.x()).square() + (leaf.position.col(1) - query.y()).square() +
         (leaf.position.col(2) - query.z()).square();
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

/// Squared distance between two boxes; 0 where they overlap.
inline float distance2(const Box& a, const Box& b) {
  const Eigen::Array3f gap = (a.low - b.high).max(b.low - a.high).max(0.0F);
  return gap.x() * gap.x() + gap.y() * gap.y() + gap.z() * gap.z();
}

}  // namespace velum::spatial
