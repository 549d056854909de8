// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "velum/neighbours.hpp"

#include <algorithm>
#include <limits>
#include <nanoflann.hpp>

#include "velum/context.hpp"

namespace velum {
namespace {

struct Adaptor {
  Points points;
  [[nodiscard]] std::size_t kdtree_get_point_count() const {
    return static_cast<std::size_t>(points.cols());
  }
  [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points(static_cast<Index>(axis), static_cast<Index>(i));
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Adaptor>,
                                                 Adaptor, 3, std::int32_t>;

bool before(const Neighbour& a, const Neighbour& b) {
  return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.index < b.index;
}

float just_above(float x) {
  return std::nextafter(x, std::numeric_limits<float>::infinity());
}

/// The k nearest as a heap whose front is the farthest.
struct Nearest {
  using DistanceType = float;
  std::size_t k;
  std::vector<Neighbour>& heap;
  [[nodiscard]] bool full() const { return heap.size() == k; }
  [[nodiscard]] float worstDist() const {
    return full() ? just_above(heap.front().distance2) : std::numeric_limits<float>::infinity();
  }
  bool addPoint(float distance2, std::int32_t index) const {
    const Neighbour candidate{index, distance2};
    if (full()) {
      if (!before(candidate, heap.front())) return true;
      std::pop_heap(heap.begin(), heap.end(), before);
      heap.pop_back();
    }
    heap.push_back(candidate);
    std::push_heap(heap.begin(), heap.end(), before);
    return true;
  }
};

struct Within {
  using DistanceType = float;
  float bound;
  std::vector<Neighbour>& found;
  [[nodiscard]] static bool full() { return true; }
  [[nodiscard]] float worstDist() const { return bound; }
  bool addPoint(float distance2, std::int32_t index) const {
    found.push_back({index, distance2});
    return true;
  }
};

float square_bound(double radius) {
  return just_above(static_cast<float>(std::min(radius * radius, 3e38)));
}

}  // namespace

struct Neighbours::Impl {
  Adaptor adaptor;
  Tree tree;
  explicit Impl(const ConstPoints& positions)
      : adaptor{positions}, tree(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {}
};

Neighbours::Neighbours(const ConstPoints& positions) : impl_(std::make_unique<Impl>(positions)) {}
Neighbours::~Neighbours() = default;

Index Neighbours::size() const {
  return impl_->adaptor.points.cols();
}

void Neighbours::nearest(const Eigen::Vector3f& query, Index k, std::vector<Neighbour>& out) const {
  out.clear();
  if (k <= 0 || size() == 0 || !query.allFinite()) return;
  Nearest result{static_cast<std::size_t>(std::min(k, size())), out};
  impl_->tree.findNeighbors(result, query.data(), nanoflann::SearchParams());
  std::sort(out.begin(), out.end(), before);
}

void Neighbours::within(const Eigen::Vector3f& query, double radius,
                        std::vector<Neighbour>& out) const {
  out.clear();
  if (!(radius >= 0.0) || size() == 0 || !query.allFinite()) return;
  Within result{square_bound(radius), out};
  impl_->tree.findNeighbors(result, query.data(), nanoflann::SearchParams());
  std::sort(out.begin(), out.end(), before);
}

Neighbour Neighbours::nearest_one(const Eigen::Vector3f& query, double radius) const {
  std::vector<Neighbour> found;
  nearest(query, 1, found);
  if (found.empty() || !(std::sqrt(static_cast<double>(found.front().distance2)) < radius))
    return {-1, std::numeric_limits<float>::infinity()};
  return found.front();
}

void Neighbours::each_nearest(Index k, Context& context, const Visitor& visit) const {
  const Points& points = impl_->adaptor.points;
  each_nearest(ConstPoints(points.data(), 3, points.cols()), k, context, visit);
}
void Neighbours::each_within(double radius, Context& context, const Visitor& visit) const {
  const Points& points = impl_->adaptor.points;
  each_within(ConstPoints(points.data(), 3, points.cols()), radius, context, visit);
}
void Neighbours::each_nearest(const ConstPoints& queries, Index k, Context& context,
                              const Visitor& visit) const {
  parallel_for(context, queries.cols(), 1024, [&](Index begin, Index end) {
    std::vector<Neighbour> found;
    for (Index i = begin; i < end; ++i) {
      nearest(queries.col(i), k, found);
      visit(i, found);
    }
  });
}
void Neighbours::each_within(const ConstPoints& queries, double radius, Context& context,
                             const Visitor& visit) const {
  parallel_for(context, queries.cols(), 1024, [&](Index begin, Index end) {
    std::vector<Neighbour> found;
    for (Index i = begin; i < end; ++i) {
      within(queries.col(i), radius, found);
      visit(i, found);
    }
  });
}

}  // namespace velum
