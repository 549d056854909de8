// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "velum/neighbours.hpp"

#include <cmath>
#include <limits>

#include "values/curve.hpp"
#include "values/point_tree.hpp"
#include "values/selection.hpp"
#include "velum/context.hpp"

namespace velum {
namespace {

using spatial::Box;
using spatial::Boxes;
using spatial::Leaf;
using spatial::PointTree;

/// Groups of queries that one thread answers in a row.
constexpr Index kGroupsAtOnce = 32;
/// A group is answered together unless its box is this many times wider than the neighbourhood.
constexpr float kWide = 8.0F;
/// More than single precision can make of distances that are found about different centres.
constexpr double kRounding = 1e-6;
constexpr double kUnderflow = 1e-21;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The largest float whose value is at most `radius` squared; negative for no radius.
float limit_of(double radius) {
  if (!(radius >= 0.0)) return -1.0F;
  const double square = radius * radius;
  if (square >= static_cast<double>(std::numeric_limits<float>::max())) return kInfinity;
  const auto limit = static_cast<float>(square);
  return static_cast<double>(limit) > square ? std::nextafter(limit, -1.0F) : limit;
}

double distance(const Eigen::Array3f& a, const Eigen::Array3f& b) {
  return (a.cast<double>() - b.cast<double>()).matrix().norm();
}

/// Squared distance that nothing within `reach` exceeds, however it was rounded.
float limit_beyond(double reach) {
  reach = reach * (1.0 + kRounding) + kUnderflow;
  return std::nextafter(static_cast<float>(reach * reach), kInfinity);
}

/// Up to sixteen queries that lie together, and their numbers.
struct Group {
  Leaf queries;
  Index count = 0;
  Box box;
  std::int32_t leaf = 0;  ///< one of the tree's that is near

  [[nodiscard]] Eigen::Array3f position(Index i) const {
    return {queries.position(i, 0), queries.position(i, 1), queries.position(i, 2)};
  }
  [[nodiscard]] Index number(Index i) const { return queries.index[static_cast<std::size_t>(i)]; }
  [[nodiscard]] float width() const { return (box.high - box.low).matrix().norm(); }
};

/// Answers groups of queries; one per thread. The leaves around a group are found once for all.
class Answerer {
 public:
  Answerer(const PointTree& tree, const Neighbours::Visitor& visit) : tree_(tree), visit_(visit) {}

  /// The `k` nearest of each query; 0 < k <= size of the set.
  void nearest(const Group& group, std::size_t k) {
    const Eigen::Array3f centre = 0.5F * group.box.low + 0.5F * group.box.high;
    // At least as many as the group has points, whose width is to be compared with the radius.
    const std::size_t enough =
        std::min(std::max<std::size_t>(k, Leaf::kSize), static_cast<std::size_t>(tree_.size()));
    const float radius = std::sqrt(tree_.limit_nearest(centre, enough, group.leaf, found_));
    if (!(group.width() <= kWide * radius) || std::isinf(radius)) {
      nearest_singly(group, k);
      return;
    }
    // The triangle inequality: k points are within `radius` of the centre, and as many within the
    // last distance found of each query before.
    Eigen::Array<double, Leaf::kSize, 1> reach;
    for (Index i = 0; i < group.count; ++i)
      reach(i) = static_cast<double>(radius) + distance(group.position(i), centre);
    find_leaves(group.box, limit_beyond(reach.head(group.count).maxCoeff()));
    for (Index i = 0; i < group.count; ++i) {
      const float limit2 = limit_beyond(reach(i));
      gather(group.position(i), limit2);
      const auto nearest = selector_.first(found_.all(), k, limit2);
      const double own = std::sqrt(static_cast<double>(nearest.back().distance2));
      for (Index j = i + 1; j < group.count; ++j)
        reach(j) = std::min(reach(j), own + distance(group.position(i), group.position(j)));
      visit_(group.number(i), nearest);
    }
  }

  /// All points of squared distance up to `limit2` of each query.
  void within(const Group& group, float limit2) {
    const bool together = group.width() <= kWide * std::sqrt(limit2);
    if (together) find_leaves(group.box, limit2);
    for (Index i = 0; i < group.count; ++i) {
      if (together) {
        gather(group.position(i), limit2);
      } else {
        tree_.gather_within(group.position(i), limit2, found_);
      }
      visit_(group.number(i), selector_.first(found_.all(), found_.size(), limit2));
    }
  }

 private:
  void nearest_singly(const Group& group, std::size_t k) {
    for (Index i = 0; i < group.count; ++i) {
      const Eigen::Array3f query = group.position(i);
      const float limit2 = tree_.gather_nearest(query, k, found_);
      visit_(group.number(i), selector_.first(found_.all(), k, limit2));
    }
  }
  void find_leaves(const Box& box, float limit2) {
    tree_.leaves_near(box, limit2, leaves_);
    boxes_.assign((leaves_.size() + Boxes::kSize - 1) / Boxes::kSize, Boxes());
    for (std::size_t i = 0; i < leaves_.size(); ++i)
      boxes_[i / Boxes::kSize].set(static_cast<Index>(i % Boxes::kSize), tree_.box(leaves_[i]));
    near_.resize(boxes_.size() * Boxes::kSize);
  }
  /// The points of leaves_ within the limit.
  void gather(const Eigen::Array3f& query, float limit2) {
    std::size_t near = 0;
    for (std::size_t i = 0; i < leaves_.size(); i += Boxes::kSize) {
      const auto distance2 = distances(boxes_[i / Boxes::kSize], {query, query});
      for (std::size_t j = 0; j < Boxes::kSize; ++j) {
        near_[near] = static_cast<std::uint32_t>(i + j);
        near += distance2(static_cast<Index>(j)) <= limit2 ? 1 : 0;
      }
    }
    found_.clear();
    Neighbour* end = found_.end_with_room((near + 1) * Leaf::kSize);
    for (std::size_t i = 0; i < near && near_[i] < leaves_.size(); ++i) {
      const auto leaf = static_cast<std::size_t>(leaves_[near_[i]]);
      end = spatial::gather(tree_.leaves()[leaf], query, limit2, end);
    }
    found_.set_end(end);
  }

  const PointTree& tree_;
  const Neighbours::Visitor& visit_;
  std::vector<std::int32_t> leaves_;
  std::vector<Boxes> boxes_;         ///< of leaves_
  std::vector<std::uint32_t> near_;  ///< numbers in leaves_ of those near one query
  spatial::Candidates found_;
  spatial::Selector selector_;
};

/// Calls answer(answerer, group) for all points of the tree.
template <class Answer>
void for_each_group(const PointTree& tree, Context& context, const Neighbours::Visitor& visit,
                    const Answer& answer) {
  const auto groups = static_cast<Index>(tree.leaves().size());
  parallel_for(context, groups, kGroupsAtOnce, [&](Index begin, Index end) {
    Answerer answerer(tree, visit);
    for (Index i = begin; i < end; ++i) {
      context.check();
      const auto leaf = static_cast<std::size_t>(i);
      answer(answerer, Group{tree.leaves()[leaf], tree.points_in(i),
                             tree.box(static_cast<std::int32_t>(i)), static_cast<std::int32_t>(i)});
    }
  });
}

/// Calls answer(answerer, group) for queries of any order: they are brought into that of a curve.
/// Those that are no numbers have no neighbours.
template <class Answer>
void for_each_group(const PointTree& tree, const ConstPoints& queries, Context& context,
                    const Neighbours::Visitor& visit, const Answer& answer) {
  Points finite(3, queries.cols());
  std::vector<std::int32_t> numbers;
  for (Index i = 0; i < queries.cols(); ++i) {
    if (queries.col(i).allFinite()) {
      finite.col(static_cast<Index>(numbers.size())) = queries.col(i);
      numbers.push_back(static_cast<std::int32_t>(i));
    } else {
      visit(i, {});
    }
  }
  const auto count = static_cast<Index>(numbers.size());
  const auto order = spatial::curve_order(ConstPoints(finite.data(), 3, count), Leaf::kSize);
  parallel_for(context, count, kGroupsAtOnce * Leaf::kSize, [&](Index begin, Index end) {
    Answerer answerer(tree, visit);
    for (Index first = begin; first < end; first += Leaf::kSize) {
      context.check();
      Group group;
      for (Index i = first; i < std::min(first + Leaf::kSize, end); ++i) {
        const std::int32_t query = order[static_cast<std::size_t>(i)];
        const auto place = static_cast<std::size_t>(group.count++);
        group.queries.index[place] = numbers[static_cast<std::size_t>(query)];
        group.queries.position.row(i - first) = finite.col(query).array();
        group.box.low = group.box.low.min(finite.col(query).array());
        group.box.high = group.box.high.max(finite.col(query).array());
      }
      group.leaf = tree.leaf_near(0.5F * group.box.low + 0.5F * group.box.high);
      answer(answerer, group);
    }
  });
}

void visit_all(Index count, Context& context, const Neighbours::Visitor& visit) {
  parallel_for(context, count, kGroupsAtOnce * Leaf::kSize, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) visit(i, {});
  });
}

/// What single queries keep from one to the next.
struct Memory {
  spatial::Candidates found;
  spatial::Selector selector;
};
Memory& memory_of_thread() {
  thread_local Memory memory;
  return memory;
}

}  // namespace

struct Neighbours::Impl : PointTree {
  using PointTree::PointTree;
};

Neighbours::Neighbours(const ConstPoints& positions) : impl_(std::make_unique<Impl>(positions)) {}
Neighbours::~Neighbours() = default;

Index Neighbours::size() const {
  return impl_->size();
}

void Neighbours::nearest(const Eigen::Vector3f& query, Index k, std::vector<Neighbour>& out) const {
  out.clear();
  if (k <= 0 || size() == 0 || !query.allFinite()) return;
  const auto number = static_cast<std::size_t>(std::min(k, size()));
  auto& [found, selector] = memory_of_thread();
  const float limit2 = impl_->gather_nearest(query, number, found);
  const auto first = selector.first(found.all(), number, limit2);
  out.assign(first.begin(), first.end());
}

void Neighbours::within(const Eigen::Vector3f& query, double radius,
                        std::vector<Neighbour>& out) const {
  out.clear();
  const float limit2 = limit_of(radius);
  if (limit2 < 0.0F || !query.allFinite()) return;
  auto& [found, selector] = memory_of_thread();
  impl_->gather_within(query, limit2, found);
  const auto all = selector.first(found.all(), found.size(), limit2);
  out.assign(all.begin(), all.end());
}

Neighbour Neighbours::nearest_one(const Eigen::Vector3f& query, double radius) const {
  const float limit2 = limit_of(radius);
  if (limit2 < 0.0F || !query.allFinite()) return {-1, kInfinity};
  const Neighbour found = impl_->nearest_one(query, limit2);
  if (found.index < 0 || !(static_cast<double>(found.distance2) < radius * radius))
    return {-1, kInfinity};
  return found;
}

void Neighbours::each_nearest(Index k, Context& context, const Visitor& visit) const {
  const auto number = static_cast<std::size_t>(std::min(k, size()));
  if (k <= 0 || size() == 0) return visit_all(size(), context, visit);
  for_each_group(*impl_, context, visit, [number](Answerer& answerer, const Group& group) {
    answerer.nearest(group, number);
  });
}

void Neighbours::each_within(double radius, Context& context, const Visitor& visit) const {
  const float limit2 = limit_of(radius);
  if (limit2 < 0.0F) return visit_all(size(), context, visit);
  for_each_group(*impl_, context, visit, [limit2](Answerer& answerer, const Group& group) {
    answerer.within(group, limit2);
  });
}

void Neighbours::each_nearest(const ConstPoints& queries, Index k, Context& context,
                              const Visitor& visit) const {
  const auto number = static_cast<std::size_t>(std::min(k, size()));
  if (k <= 0 || size() == 0) return visit_all(queries.cols(), context, visit);
  for_each_group(*impl_, queries, context, visit, [number](Answerer& answerer, const Group& group) {
    answerer.nearest(group, number);
  });
}

void Neighbours::each_within(const ConstPoints& queries, double radius, Context& context,
                             const Visitor& visit) const {
  const float limit2 = limit_of(radius);
  if (limit2 < 0.0F) return visit_all(queries.cols(), context, visit);
  for_each_group(*impl_, queries, context, visit, [limit2](Answerer& answerer, const Group& group) {
    answerer.within(group, limit2);
  });
}

}  // namespace velum
