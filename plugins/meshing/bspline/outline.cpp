// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "outline.hpp"

#include <algorithm>
#include <queue>

#include "cgal/delaunay_2.hpp"
#include "mesh/topology.hpp"

namespace velum::meshing {
namespace {

constexpr double kLongEdge = 3.0;    // of the spacing around its ends
constexpr double kHoleRadius = 3.0;  // circumradius, of the spacing

using mesh::Triangle;
using Triangles = std::vector<Triangle>;

ConstTriangles view(const Triangles& triangles) {
  return {triangles.empty() ? nullptr : triangles.front().data(), 3,
          static_cast<Index>(triangles.size())};
}

// Median length of the edges at each point.
Eigen::VectorXd spacing_of(const Eigen::Matrix2Xd& plane, const Triangles& triangles) {
  std::vector<std::vector<double>> lengths(static_cast<std::size_t>(plane.cols()));
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = (plane.col(t[k]) - plane.col(t[(k + 1) % 3])).norm();
      lengths[static_cast<std::size_t>(t[k])].push_back(length);
      lengths[static_cast<std::size_t>(t[(k + 1) % 3])].push_back(length);
    }
  Eigen::VectorXd spacing = Eigen::VectorXd::Zero(plane.cols());
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (lengths[i].empty()) continue;
    const auto middle = lengths[i].begin() + static_cast<std::ptrdiff_t>(lengths[i].size() / 2);
    std::nth_element(lengths[i].begin(), middle, lengths[i].end());
    spacing[static_cast<Index>(i)] = *middle;
  }
  return spacing;
}

class Peeler {
 public:
  Peeler(const Eigen::Matrix2Xd& plane, const Triangles& triangles, const Eigen::VectorXd& spacing)
      : plane_(plane),
        triangles_(triangles),
        spacing_(spacing),
        across_(mesh::adjacency(view(triangles)).across),
        alive_(triangles.size(), 1),
        outer_(static_cast<std::size_t>(plane.cols()), 0) {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t side = 0; side < 3; ++side) {
        if (across_[t][side] >= 0) continue;
        outer_[static_cast<std::size_t>(triangles[t][side])] = 1;
        outer_[static_cast<std::size_t>(triangles[t][(side + 1) % 3])] = 1;
      }
  }

  Triangles peel() {
    for (std::size_t t = 0; t < triangles_.size(); ++t) offer(t);
    while (!queue_.empty()) {
      const auto t = static_cast<std::size_t>(-queue_.top().second);
      queue_.pop();
      if (alive_[t] != 0 && outer_side(t) >= 0) remove(t);
    }
    Triangles left;
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      if (alive_[t] != 0) left.push_back(triangles_[t]);
    return left;
  }

 private:
  // The only outer side of a triangle with an inner apex; -1 when there is none.
  [[nodiscard]] int outer_side(std::size_t t) const {
    int found = -1;
    for (int side = 0; side < 3; ++side) {
      if (across_[t][static_cast<std::size_t>(side)] >= 0) continue;
      if (found >= 0) return -1;
      found = side;
    }
    if (found < 0) return -1;
    const auto apex =
        static_cast<std::size_t>(triangles_[t][static_cast<std::size_t>(found + 2) % 3]);
    return outer_[apex] != 0 ? -1 : found;
  }
  void offer(std::size_t t) {
    const int side = outer_side(t);
    if (side < 0) return;
    const std::int32_t a = triangles_[t][static_cast<std::size_t>(side)];
    const std::int32_t b = triangles_[t][static_cast<std::size_t>(side + 1) % 3];
    const double length = (plane_.col(a) - plane_.col(b)).norm();
    if (length > kLongEdge * std::max(spacing_[a], spacing_[b]))
      queue_.emplace(length, -static_cast<std::int64_t>(t));
  }
  void remove(std::size_t t) {
    alive_[t] = 0;
    for (const std::int32_t vertex : triangles_[t]) outer_[static_cast<std::size_t>(vertex)] = 1;
    for (const std::int32_t other : across_[t]) {
      if (other < 0) continue;
      auto& back = across_[static_cast<std::size_t>(other)];
      std::replace(back.begin(), back.end(), static_cast<std::int32_t>(t), mesh::kBorder);
      offer(static_cast<std::size_t>(other));
    }
  }

  const Eigen::Matrix2Xd& plane_;
  const Triangles& triangles_;
  const Eigen::VectorXd& spacing_;
  std::vector<Triangle> across_;
  std::vector<char> alive_;
  std::vector<char> outer_;
  std::priority_queue<std::pair<double, std::int64_t>> queue_;
};

// Loops around groups of wide triangles that share no point with the outer loop.
std::vector<std::vector<std::int32_t>> holes_in(const Eigen::Matrix2Xd& plane,
                                                const Triangles& triangles,
                                                const Eigen::VectorXd& spacing,
                                                const std::vector<char>& on_loop) {
  Triangles wide;
  for (const Triangle& t : triangles) {
    double usual = 0.0;
    double product = 1.0;
    for (std::size_t k = 0; k < 3; ++k) {
      product *= (plane.col(t[k]) - plane.col(t[(k + 1) % 3])).norm();
      usual = std::max(usual, spacing[t[k]]);
    }
    const Eigen::Vector2d a = plane.col(t[1]) - plane.col(t[0]);
    const Eigen::Vector2d b = plane.col(t[2]) - plane.col(t[0]);
    // All triangles across an empty disc have about its radius.
    const double radius = product / std::max(2.0 * (a.x() * b.y() - a.y() * b.x()), 1e-300);
    if (radius > kHoleRadius * usual) wide.push_back(t);
  }
  std::vector<std::vector<std::int32_t>> holes;
  for (auto& loop : mesh::border_loops(view(wide), mesh::adjacency(view(wide)))) {
    const bool inner = std::none_of(loop.begin(), loop.end(), [&](std::int32_t v) {
      return on_loop[static_cast<std::size_t>(v)] != 0;
    });
    double twice = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Eigen::Vector2d a = plane.col(loop[i]);
      const Eigen::Vector2d b = plane.col(loop[(i + 1) % loop.size()]);
      twice += a.x() * b.y() - a.y() * b.x();
    }
    // An inner border of a group, around points inside the hole, runs the other way.
    if (inner && loop.size() >= 4 && twice > 0.0) holes.push_back(std::move(loop));
  }
  return holes;
}

}  // namespace

PointOutline find_outline(const Eigen::Matrix2Xd& plane, Context& context) {
  const Triangles all = cgal::delaunay_2(plane);
  context.check();
  if (all.empty()) throw Error(Fault::stage, "the points lie on a line, a surface was expected");
  PointOutline outline;
  outline.spacing = spacing_of(plane, all);
  const Triangles left = Peeler(plane, all, outline.spacing).peel();
  context.check();
  outline.loop = mesh::border_loops(view(left), mesh::adjacency(view(left))).front();
  std::vector<char> on_loop(static_cast<std::size_t>(plane.cols()), 0);
  for (const std::int32_t v : outline.loop) on_loop[static_cast<std::size_t>(v)] = 1;
  std::vector<char> near = on_loop;
  for (const Triangle& t : left)
    for (const std::int32_t v : t)
      if (on_loop[static_cast<std::size_t>(v)] != 0)
        for (const std::int32_t other : t) near[static_cast<std::size_t>(other)] = 1;
  for (std::size_t i = 0; i < near.size(); ++i)
    if (near[i] != 0) outline.near.push_back(static_cast<std::int32_t>(i));
  outline.holes = holes_in(plane, left, outline.spacing, on_loop);
  return outline;
}

}  // namespace velum::meshing
