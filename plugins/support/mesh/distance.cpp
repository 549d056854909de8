// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "mesh/distance.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <vector>

namespace velum::mesh {

Eigen::Vector3d closest_on_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                    const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const Eigen::Vector3d ap = p - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const Eigen::Vector3d bp = p - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
  const Eigen::Vector3d cp = p - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double sum = va + vb + vc;
  return sum > 0.0 ? Eigen::Vector3d(a + vb / sum * ab + vc / sum * ac) : a;
}

struct DistanceTree::Impl {
  using Box = Eigen::AlignedBox3d;
  struct Corners {
    Eigen::Vector3d a, b, c;
  };
  struct Node {
    Box box;
    std::int32_t begin = 0, end = 0;  // triangles of a leaf
    std::int32_t left = -1;           // children are left and left + 1; -1: a leaf
  };
  static constexpr std::int32_t kLeaf = 4;

  std::vector<Corners> corners;
  std::vector<std::int32_t> order;
  std::vector<Node> nodes;

  void build(std::size_t index) {
    const std::int32_t begin = nodes[index].begin;
    const std::int32_t end = nodes[index].end;
    Box centres;
    for (std::int32_t i = begin; i < end; ++i) {
      const Corners& t = corners[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])];
      nodes[index].box.extend(t.a).extend(t.b).extend(t.c);
      centres.extend(t.a + t.b + t.c);
    }
    if (end - begin <= kLeaf) return;
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    const auto at = [&](std::int32_t i) { return order.begin() + i; };
    const auto key = [&](std::int32_t t) {
      const Corners& k = corners[static_cast<std::size_t>(t)];
      return k.a[axis] + k.b[axis] + k.c[axis];
    };
    const std::int32_t middle = begin + (end - begin) / 2;
    std::nth_element(at(begin), at(middle), at(end), [&](std::int32_t s, std::int32_t t) {
      return std::pair(key(s), s) < std::pair(key(t), t);
    });
    const auto left = nodes.size();
    nodes[index].left = static_cast<std::int32_t>(left);
    nodes.resize(left + 2);
    nodes[left].begin = begin;
    nodes[left].end = nodes[left + 1].begin = middle;
    nodes[left + 1].end = end;
    build(left);
    build(left + 1);
  }

  void search(std::size_t index, const Eigen::Vector3d& query, Hit& best) const {
    const Node& node = nodes[index];
    if (node.left < 0) {
      for (std::int32_t i = node.begin; i < node.end; ++i) {
        const std::int32_t t = order[static_cast<std::size_t>(i)];
        const Corners& k = corners[static_cast<std::size_t>(t)];
        const Eigen::Vector3d point = closest_on_triangle(query, k.a, k.b, k.c);
        const double d2 = (point - query).squaredNorm();
        if (d2 < best.distance2 || (d2 == best.distance2 && t < best.triangle))
          best = {point, d2, t};
      }
      return;
    }
    auto near = static_cast<std::size_t>(node.left);
    std::size_t far = near + 1;
    double near2 = nodes[near].box.squaredExteriorDistance(query);
    double far2 = nodes[far].box.squaredExteriorDistance(query);
    if (far2 < near2) {
      std::swap(near, far);
      std::swap(near2, far2);
    }
    if (near2 <= best.distance2) search(near, query, best);
    if (far2 <= best.distance2) search(far, query, best);
  }
};

DistanceTree::DistanceTree(const Mesh& mesh) : impl_(std::make_unique<Impl>()) {
  const auto positions = mesh.positions();
  const auto triangles = mesh.triangles();
  for (Index t = 0; t < triangles.cols(); ++t)
    impl_->corners.push_back({positions.col(triangles(0, t)).cast<double>(),
                              positions.col(triangles(1, t)).cast<double>(),
                              positions.col(triangles(2, t)).cast<double>()});
  impl_->order.resize(impl_->corners.size());
  std::iota(impl_->order.begin(), impl_->order.end(), 0);
  if (impl_->order.empty()) return;
  impl_->nodes.resize(1);
  impl_->nodes[0].end = static_cast<std::int32_t>(impl_->order.size());
  impl_->build(0);
}

DistanceTree::~DistanceTree() = default;

DistanceTree::Hit DistanceTree::closest(const Eigen::Vector3d& query) const {
  Hit best;
  best.distance2 = std::numeric_limits<double>::infinity();
  if (!impl_->nodes.empty()) impl_->search(0, query, best);
  return best;
}

}  // namespace velum::mesh
