// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "scene/caster.hpp"

namespace velum::scene {
namespace {

using Eigen::Vector3d;

constexpr std::int32_t kLeaf = 4;

// Distances at which a ray is inside a box; enter > leave when it misses.
struct Stretch {
  double enter;
  double leave;
};
Stretch inside(const Eigen::AlignedBox3d& box, const Ray& ray, const Vector3d& inverse) {
  const Vector3d a = (box.min() - ray.from).cwiseProduct(inverse);
  const Vector3d b = (box.max() - ray.from).cwiseProduct(inverse);
  return {a.cwiseMin(b).maxCoeff(), a.cwiseMax(b).minCoeff()};
}

}  // namespace

void TriangleTree::add(const TriangleSet& set, std::int32_t owner) {
  triangles_.reserve(triangles_.size() + static_cast<std::size_t>(set.triangles.cols()));
  for (Index i = 0; i < set.triangles.cols(); ++i) {
    const Vector3d a = set.vertices.col(set.triangles(0, i));
    triangles_.push_back({a, set.vertices.col(set.triangles(1, i)) - a,
                          set.vertices.col(set.triangles(2, i)) - a, owner});
  }
}

void TriangleTree::build() {
  nodes_.clear();
  if (!triangles_.empty()) split(0, static_cast<std::int32_t>(triangles_.size()));
}

// Median split along the longest side of the centres' box; nodes in depth-first order.
void TriangleTree::split(std::int32_t begin, std::int32_t end) {
  const std::size_t self = nodes_.size();
  nodes_.emplace_back();
  Eigen::AlignedBox3d box;
  Eigen::AlignedBox3d centres;
  for (std::int32_t i = begin; i < end; ++i) {
    const Triangle& t = triangles_[static_cast<std::size_t>(i)];
    box.extend(t.corner).extend(t.corner + t.first).extend(t.corner + t.second);
    centres.extend(t.centre());
  }
  nodes_[self].box = box;
  if (end - begin <= kLeaf) {
    nodes_[self].second = begin;
    nodes_[self].count = end - begin;
    return;
  }
  int axis = 0;
  centres.sizes().maxCoeff(&axis);
  const std::int32_t middle = begin + (end - begin) / 2;
  std::nth_element(
      triangles_.begin() + begin, triangles_.begin() + middle, triangles_.begin() + end,
      [axis](const Triangle& a, const Triangle& b) { return a.centre()[axis] < b.centre()[axis]; });
  nodes_[self].axis = axis;
  split(begin, middle);
  nodes_[self].second = static_cast<std::int32_t>(nodes_.size());
  split(middle, end);
}

std::optional<TriangleTree::Hit> TriangleTree::meet(const Ray& ray, const Reach& reach) const {
  // Möller and Trumbore (1997), edges included: a ray through a shared edge must not slip between.
  constexpr double kSlack = 1e-9;
  if (nodes_.empty()) return std::nullopt;
  // A finite stand-in for 1/0, so that a box's face in the ray's plane gives 0 and not NaN.
  const Vector3d slopes =
      ray.along.unaryExpr([](double x) { return std::abs(x) > 1e-300 ? 1.0 / x : 1e300; });
  std::array<std::int32_t, 64> stack{};
  std::size_t depth = 0;
  std::int32_t at = 0;
  std::optional<Hit> best;
  double far = reach.far;
  const auto try_leaf = [&](const Node& node) {
    for (std::int32_t i = node.second; i < node.second + node.count; ++i) {
      const Triangle& t = triangles_[static_cast<std::size_t>(i)];
      const Vector3d p = ray.along.cross(t.second);
      const double volume = t.first.dot(p);
      if (volume == 0.0) continue;
      const Vector3d s = ray.from - t.corner;
      const double u = s.dot(p) / volume;
      if (u < -kSlack || u > 1.0 + kSlack) continue;
      const Vector3d q = s.cross(t.first);
      const double v = ray.along.dot(q) / volume;
      if (v < -kSlack || u + v > 1.0 + kSlack) continue;
      const double range = t.second.dot(q) / volume;
      if (range < reach.near || range > far) continue;
      far = range;
      best = {range, t.owner, i};
    }
  };
  for (;;) {
    const Node& node = nodes_[static_cast<std::size_t>(at)];
    const Stretch stretch = inside(node.box, ray, slopes);
    const bool seen = stretch.enter <= stretch.leave + kSlack && stretch.leave >= reach.near &&
                      stretch.enter <= far;
    if (seen && node.count == 0) {
      const bool backwards = ray.along[node.axis] < 0.0;
      stack[depth++] = backwards ? at + 1 : node.second;
      at = backwards ? node.second : at + 1;
      continue;
    }
    if (seen) try_leaf(node);
    if (depth == 0) return best;
    at = stack[--depth];
  }
}

Vector3d TriangleTree::normal(std::int32_t triangle) const {
  const Triangle& t = triangles_[static_cast<std::size_t>(triangle)];
  return t.first.cross(t.second).normalized();
}

}  // namespace velum::scene
