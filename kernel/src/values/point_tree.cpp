// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "values/point_tree.hpp"

#include "values/curve.hpp"

namespace velum::spatial {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::size_t blocks(std::size_t count, std::size_t size) {
  return (count + size - 1) / size;
}

Box united(const Box& a, const Box& b) {
  return {a.low.min(b.low), a.high.max(b.high)};
}

void fill(Leaf& leaf, Box& box, const ConstPoints& positions,
          std::span<const std::int32_t> indices) {
  leaf.position.fill(std::numeric_limits<float>::quiet_NaN());
  leaf.index.fill(-1);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const Eigen::Array3f position = positions.col(indices[i]);
    leaf.position.row(static_cast<Index>(i)) = position;
    leaf.index[i] = indices[i];
    box = united(box, {position, position});
  }
}

}  // namespace

PointTree::PointTree(const ConstPoints& positions) : size_(positions.cols()) {
  const auto order = curve_order(positions, Leaf::kSize);
  leaves_.resize(blocks(order.size(), Leaf::kSize));
  boxes_.resize(leaves_.size());
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    const auto begin = order.begin() + static_cast<std::ptrdiff_t>(i * Leaf::kSize);
    fill(leaves_[i], boxes_[i], positions, {begin, begin + points_in(static_cast<Index>(i))});
  }
  std::vector<Box> below = boxes_;
  while (levels_.empty() ? !below.empty() : below.size() > 1) {
    std::vector<Box> above(blocks(below.size(), Boxes::kSize));
    auto& level = levels_.emplace_back(above.size());
    for (std::size_t i = 0; i < below.size(); ++i) {
      const auto child = static_cast<Index>(i % Boxes::kSize);
      level[i / Boxes::kSize].set(child, below[i]);
      above[i / Boxes::kSize] = united(above[i / Boxes::kSize], below[i]);
    }
    below = std::move(above);
  }
}

std::size_t PointTree::children_of(std::size_t level, std::size_t number) const {
  const std::size_t below = level == 0 ? leaves_.size() : levels_[level - 1].size();
  return std::min<std::size_t>(Boxes::kSize, below - number * Boxes::kSize);
}

template <class OnLeaf>
void PointTree::descend(const Box& query, const float& limit2, const OnLeaf& on_leaf) const {
  if (leaves_.empty()) return;
  struct Entry {
    float distance2;
    std::int32_t level;  ///< -1: a leaf
    std::int32_t number;
  };
  // Each level leaves at most seven behind, and there are fewer than ten for 2^31 points.
  std::array<Entry, 80> stack;
  std::size_t top = 0;
  stack[top++] = {0.0F, static_cast<std::int32_t>(levels_.size()) - 1, 0};
  while (top > 0) {
    const Entry entry = stack[--top];
    if (entry.distance2 > limit2) continue;
    if (entry.level < 0) {
      on_leaf(entry.number);
      continue;
    }
    const auto number = static_cast<std::size_t>(entry.number);
    const auto level = static_cast<std::size_t>(entry.level);
    const auto distance2 = distances(levels_[level][number], query);
    const std::size_t bottom = top;
    const std::size_t children = children_of(level, number);
    for (std::size_t i = 0; i < children; ++i) {
      const float distance = distance2(static_cast<Index>(i));
      if (distance > limit2) continue;
      // The nearest on top.
      std::size_t place = top++;
      for (; place > bottom && stack[place - 1].distance2 < distance; --place)
        stack[place] = stack[place - 1];
      stack[place] = {distance, entry.level - 1,
                      static_cast<std::int32_t>(number * Boxes::kSize + i)};
    }
  }
}

float PointTree::limit_nearest(const Eigen::Array3f& query, std::size_t k, std::int32_t leaf,
                               Candidates& memory) const {
  // Enough leaves on either side, since the curve may leave the neighbourhood on one of them.
  const auto middle = static_cast<std::size_t>(leaf);
  const std::size_t side = blocks(k, Leaf::kSize);
  const std::size_t begin = middle - std::min(middle, side);
  const std::size_t end = std::min(leaves_.size(), middle + side + 1);
  memory.clear();
  for (std::size_t i = begin; i < end; ++i)
    memory.set_end(gather(leaves_[i], query, kInfinity, memory.end_with_room(Leaf::kSize)));
  const auto all = memory.all();
  const auto kth = all.begin() + static_cast<std::ptrdiff_t>(k - 1);
  std::nth_element(all.begin(), kth, all.end(), before);
  return kth->distance2;
}

std::int32_t PointTree::leaf_near(const Eigen::Array3f& query) const {
  std::size_t number = 0;
  for (std::size_t level = levels_.size(); level-- > 0;) {
    const auto distance2 = distances(levels_[level][number], {query, query});
    const std::size_t children = children_of(level, number);
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < children; ++i)
      if (distance2(static_cast<Index>(i)) < distance2(static_cast<Index>(nearest))) nearest = i;
    number = number * Boxes::kSize + nearest;
  }
  return static_cast<std::int32_t>(number);
}

float PointTree::gather_nearest(const Eigen::Array3f& query, std::size_t k, Candidates& out) const {
  float limit2 = kInfinity;
  std::size_t enough = k;
  out.clear();
  descend({query, query}, limit2, [&](std::int32_t number) {
    const Leaf& leaf = leaves_[static_cast<std::size_t>(number)];
    out.set_end(gather(leaf, query, limit2, out.end_with_room(Leaf::kSize)));
    if (out.size() < enough) return;
    // Forget all behind the k-th, then wait until that is worth while again.
    const auto all = out.all();
    const auto kth = all.begin() + static_cast<std::ptrdiff_t>(k - 1);
    std::nth_element(all.begin(), kth, all.end(), before);
    limit2 = kth->distance2;
    out.set_end(&*kth + 1);
    enough = k + std::max<std::size_t>(k / 2, Leaf::kSize);
  });
  return limit2;
}

void PointTree::gather_within(const Eigen::Array3f& query, float limit2, Candidates& out) const {
  out.clear();
  descend({query, query}, limit2, [&](std::int32_t number) {
    const Leaf& leaf = leaves_[static_cast<std::size_t>(number)];
    out.set_end(gather(leaf, query, limit2, out.end_with_room(Leaf::kSize)));
  });
}

Neighbour PointTree::nearest_one(const Eigen::Array3f& query, float limit2) const {
  Neighbour best{-1, kInfinity};
  const auto look = [&](std::int32_t number) {
    const Leaf& leaf = leaves_[static_cast<std::size_t>(number)];
    const auto distance2 = spatial::distances(leaf, query);
    if (!(distance2 <= limit2).any()) return;
    for (std::size_t i = 0; i < Leaf::kSize; ++i) {
      const Neighbour candidate{leaf.index[i], distance2(static_cast<Index>(i))};
      if (!(candidate.distance2 <= limit2)) continue;
      if (best.index >= 0 && !before(candidate, best)) continue;
      best = candidate;
      limit2 = candidate.distance2;
    }
  };
  if (leaves_.empty()) return best;
  look(leaf_near(query));  // a good limit from the start
  descend({query, query}, limit2, look);
  return best;
}

void PointTree::leaves_near(const Box& box, float limit2, std::vector<std::int32_t>& out) const {
  out.clear();
  descend(box, limit2, [&](std::int32_t leaf) { out.push_back(leaf); });
}

}  // namespace velum::spatial
