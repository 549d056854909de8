// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "trim.hpp"

#include <algorithm>
#include <numeric>
#include <queue>

#include "mesh/build.hpp"

namespace velum::meshing {
namespace {

constexpr double kLongEdge = 6.0;      // of the local spacing
constexpr double kSliverRadius = 4.0;  // circumradius, of the local spacing

using Triangles = std::vector<mesh::Triangle>;

double edge_length(const ConstPoints& positions, std::int32_t a, std::int32_t b) {
  return (positions.col(a).cast<double>() - positions.col(b).cast<double>()).norm();
}

/// Keeps the triangles whose flag is set.
void keep(Triangles& triangles, const std::vector<char>& flags) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (flags[t] != 0) triangles[kept++] = triangles[t];
  triangles.resize(kept);
}

bool keep_largest_part(Triangles& triangles) {
  const mesh::Components parts = mesh::components(mesh::adjacency(mesh::view(triangles)));
  if (parts.count <= 1) return false;
  std::vector<Index> sizes(static_cast<std::size_t>(parts.count), 0);
  for (const std::int32_t part : parts.of) ++sizes[static_cast<std::size_t>(part)];
  const auto largest = std::max_element(sizes.begin(), sizes.end()) - sizes.begin();
  std::vector<char> flags;
  for (const std::int32_t part : parts.of) flags.push_back(part == largest ? 1 : 0);
  keep(triangles, flags);
  return true;
}

/// Triangles around each vertex, in ascending order.
struct Fans {
  std::vector<std::size_t> first;
  std::vector<std::int32_t> triangles;

  Fans(const Triangles& all, Index vertices) : first(static_cast<std::size_t>(vertices) + 1, 0) {
    for (const auto& t : all)
      for (const std::int32_t v : t) ++first[static_cast<std::size_t>(v) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    triangles.resize(first.back());
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for (std::size_t i = 0; i < all.size(); ++i)
      for (const std::int32_t v : all[i])
        triangles[next[static_cast<std::size_t>(v)]++] = static_cast<std::int32_t>(i);
  }
  [[nodiscard]] std::span<const std::int32_t> at(std::int32_t vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return {triangles.data() + first[v], first[v + 1] - first[v]};
  }
};

/// Splits the triangles around a vertex into fans and clears the flags of all but the largest.
bool clear_small_fans(const mesh::Adjacency& adjacency, std::span<const std::int32_t> around,
                      std::vector<char>& flags) {
  std::vector<std::vector<std::int32_t>> fans;
  std::vector<std::int32_t> left(around.begin(), around.end());
  while (!left.empty()) {
    std::vector<std::int32_t> fan{left.front()};
    left.erase(left.begin());
    for (std::size_t i = 0; i < fan.size(); ++i) {
      for (const std::int32_t next : adjacency.across[static_cast<std::size_t>(fan[i])]) {
        const auto found = std::find(left.begin(), left.end(), next);
        if (found == left.end()) continue;
        fan.push_back(next);
        left.erase(found);
      }
    }
    fans.push_back(std::move(fan));
  }
  if (fans.size() < 2) return false;
  const auto largest = std::max_element(
      fans.begin(), fans.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  for (auto fan = fans.begin(); fan != fans.end(); ++fan)
    if (fan != largest)
      for (const std::int32_t t : *fan) flags[static_cast<std::size_t>(t)] = 0;
  return true;
}

bool remove_pinches(Triangles& triangles, Index vertices) {
  const mesh::Adjacency adjacency = mesh::adjacency(mesh::view(triangles));
  if (mesh::pinched_vertices(mesh::view(triangles), adjacency) == 0) return false;
  const Fans fans(triangles, vertices);
  std::vector<char> flags(triangles.size(), 1);
  for (std::int32_t v = 0; v < vertices; ++v) clear_small_fans(adjacency, fans.at(v), flags);
  keep(triangles, flags);
  return true;
}

/// A triangle on the border that may be peeled off.
struct Sliver {
  double flatness;  // circumradius over spacing
  std::int32_t triangle;
  bool operator<(const Sliver& other) const {
    return std::pair(flatness, -triangle) < std::pair(other.flatness, -other.triangle);
  }
};

class Peeler {
 public:
  Peeler(const Triangles& triangles, const ConstPoints& positions, const TrimRules& rules)
      : triangles_(triangles),
        positions_(positions),
        rules_(rules),
        adjacency_(mesh::adjacency(mesh::view(triangles))),
        alive_(triangles.size(), 1),
        on_border_(static_cast<std::size_t>(positions.cols()), 0) {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t side = 0; side < 3; ++side)
        if (adjacency_.across[t][side] == mesh::kBorder) mark_side(t, side);
  }

  std::vector<char> peel() {
    for (std::size_t t = 0; t < triangles_.size(); ++t) offer(t);
    while (!queue_.empty()) {
      const auto t = static_cast<std::size_t>(queue_.top().triangle);
      queue_.pop();
      // It may have got a second border edge, or its apex may have reached the border, since.
      if (alive_[t] != 0 && removable(t) >= 0) remove(t);
    }
    return alive_;
  }

 private:
  void mark_side(std::size_t t, std::size_t side) {
    on_border_[static_cast<std::size_t>(triangles_[t][side])] = 1;
    on_border_[static_cast<std::size_t>(triangles_[t][(side + 1) % 3])] = 1;
  }

  /// The only border side of a triangle whose apex is inside; -1 when there is none.
  [[nodiscard]] int removable(std::size_t t) const {
    int found = -1;
    for (int side = 0; side < 3; ++side) {
      if (adjacency_.across[t][static_cast<std::size_t>(side)] >= 0) continue;
      if (found >= 0) return -1;
      found = side;
    }
    if (found < 0) return -1;
    const std::int32_t apex = triangles_[t][static_cast<std::size_t>((found + 2) % 3)];
    return on_border_[static_cast<std::size_t>(apex)] != 0 ? -1 : found;
  }

  void offer(std::size_t t) {
    const int side = removable(t);
    if (side < 0) return;
    const std::int32_t a = triangles_[t][static_cast<std::size_t>(side)];
    const std::int32_t b = triangles_[t][static_cast<std::size_t>((side + 1) % 3)];
    const std::int32_t apex = triangles_[t][static_cast<std::size_t>((side + 2) % 3)];
    const Eigen::Vector3d to_a = (positions_.col(a) - positions_.col(apex)).cast<double>();
    const Eigen::Vector3d to_b = (positions_.col(b) - positions_.col(apex)).cast<double>();
    if (to_a.dot(to_b) >= 0.0) return;  // not obtuse at the apex: no sliver
    const double twice_sine = 2.0 * to_a.cross(to_b).norm() / (to_a.norm() * to_b.norm());
    const double radius = (to_a - to_b).norm() / std::max(twice_sine, 1e-12);
    const double spacing = std::max({rules_.spacing[a], rules_.spacing[b], rules_.spacing[apex]});
    if (radius > kSliverRadius * spacing)
      queue_.push({radius / spacing, static_cast<std::int32_t>(t)});
  }

  void remove(std::size_t t) {
    alive_[t] = 0;
    for (const std::int32_t vertex : triangles_[t])
      on_border_[static_cast<std::size_t>(vertex)] = 1;
    for (const std::int32_t other : adjacency_.across[t]) {
      if (other < 0) continue;
      auto& across = adjacency_.across[static_cast<std::size_t>(other)];
      std::replace(across.begin(), across.end(), static_cast<std::int32_t>(t), mesh::kBorder);
      offer(static_cast<std::size_t>(other));
    }
  }

  const Triangles& triangles_;
  const ConstPoints& positions_;
  const TrimRules& rules_;
  mesh::Adjacency adjacency_;
  std::vector<char> alive_;
  std::vector<char> on_border_;
  std::priority_queue<Sliver> queue_;
};

}  // namespace

Eigen::VectorXf local_spacing(const Cloud& cloud, Context& context) {
  Eigen::VectorXf spacing = Eigen::VectorXf::Zero(cloud.size());
  cloud.neighbours().each_nearest(7, context, [&](Index i, std::span<const Neighbour> near) {
    spacing[i] = near.empty() ? 0.0F : std::sqrt(near.back().distance2);
  });
  return spacing;
}

void remove_long(Triangles& triangles, const ConstPoints& positions, const TrimRules& rules) {
  const auto too_long = [&](std::int32_t a, std::int32_t b) {
    const double allowed = rules.max_edge > 0.0
                               ? rules.max_edge
                               : kLongEdge * std::max(rules.spacing[a], rules.spacing[b]);
    return edge_length(positions, a, b) > allowed;
  };
  std::erase_if(triangles, [&](const mesh::Triangle& t) {
    return too_long(t[0], t[1]) || too_long(t[1], t[2]) || too_long(t[2], t[0]);
  });
  // Cutting one kind of fault can leave the other; each round removes triangles, so it ends.
  while (keep_largest_part(triangles) || remove_pinches(triangles, positions.cols())) {
  }
}

void peel_slivers(Triangles& triangles, const ConstPoints& positions, const TrimRules& rules) {
  keep(triangles, Peeler(triangles, positions, rules).peel());
}

}  // namespace velum::meshing
