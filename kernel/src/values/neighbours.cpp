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
using spatial::Leaf;
using spatial::PointTree;

/// Groups of queries that one thread answers in a row.
constexpr Index kGroupsAtOnce = 32;
/// A group is answered together unless its box is this many times wider than the neighbourhood.
constexpr float kWide = 4.0F;
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

/// Up to sixteen queries that lie together, and their numbers.
struct Group {
  Leaf queries;
  Index count = 0;
  Box box;

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
    const float radius = std::sqrt(tree_.gather_nearest(centre, k, found_));
    if (!(group.width() <= kWide * radius) || std::isinf(radius)) {
      nearest_singly(group, k);
      return;
    }
    // The triangle inequality: k points are within `radius` of the centre.
    std::array<float, Leaf::kSize> limits2{};
    for (Index i = 0; i < group.count; ++i) {
      const double away = (group.position(i) - centre).matrix().cast<double>().norm();
      const double reach = (static_cast<double>(radius) + away) * (1.0 + kRounding) + kUnderflow;
      limits2[static_cast<std::size_t>(i)] =
          std::nextafter(static_cast<float>(reach * reach), kInfinity);
    }
    tree_.leaves_near(group.box, *std::max_element(limits2.begin(), limits2.end()), leaves_);
    for (Index i = 0; i < group.count; ++i) {
      const float limit2 = limits2[static_cast<std::size_t>(i)];
      gather(group.position(i), limit2);
      selector_.first(found_, k, limit2);
      visit_(group.number(i), found_);
    }
  }

  /// All points of squared distance up to `limit2` of each query.
  void within(const Group& group, float limit2) {
    const bool together = group.width() <= kWide * std::sqrt(limit2);
    if (together) tree_.leaves_near(group.box, limit2, leaves_);
    for (Index i = 0; i < group.count; ++i) {
      if (together) {
        gather(group.position(i), limit2);
      } else {
        tree_.gather_within(group.position(i), limit2, found_);
      }
      selector_.first(found_, found_.size(), limit2);
      visit_(group.number(i), found_);
    }
  }

 private:
  void nearest_singly(const Group& group, std::size_t k) {
    for (Index i = 0; i < group.count; ++i) {
      const float limit2 = tree_.gather_nearest(group.position(i), k, found_);
      selector_.first(found_, k, limit2);
      visit_(group.number(i), found_);
    }
  }
  /// The points of leaves_ within the limit.
  void gather(const Eigen::Array3f& query, float limit2) {
    found_.resize((leaves_.size() + 1) * Leaf::kSize);
    Neighbour* end = found_.data();
    for (const std::int32_t leaf : leaves_) {
      if (distance2(tree_.box(leaf), {query, query}) > limit2) continue;
      end = spatial::gather(tree_.leaves()[static_cast<std::size_t>(leaf)], query, limit2, end);
    }
    found_.resize(static_cast<std::size_t>(end - found_.data()));
  }

  const PointTree& tree_;
  const Neighbours::Visitor& visit_;
  std::vector<std::int32_t> leaves_;
  std::vector<Neighbour> found_;
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
      answer(answerer,
             Group{tree.leaves()[leaf], tree.points_in(i), tree.box(static_cast<std::int32_t>(i))});
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
      answer(answerer, group);
    }
  });
}

void visit_all(Index count, Context& context, const Neighbours::Visitor& visit) {
  parallel_for(context, count, kGroupsAtOnce * Leaf::kSize, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) visit(i, {});
  });
}

spatial::Selector& selector_of_thread() {
  thread_local spatial::Selector selector;
  return selector;
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
  const float limit2 = impl_->gather_nearest(query, number, out);
  selector_of_thread().first(out, number, limit2);
}

void Neighbours::within(const Eigen::Vector3f& query, double radius,
                        std::vector<Neighbour>& out) const {
  out.clear();
  const float limit2 = limit_of(radius);
  if (limit2 < 0.0F || !query.allFinite()) return;
  impl_->gather_within(query, limit2, out);
  selector_of_thread().first(out, out.size(), limit2);
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
