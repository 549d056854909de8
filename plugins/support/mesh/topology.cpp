// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "mesh/topology.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>

namespace velum::mesh {
namespace {

struct HalfEdge {
  std::int32_t low, high;  // its vertices, ascending
  std::int32_t triangle, side;
  bool ascending;  // runs from low to high
  [[nodiscard]] bool same_edge(const HalfEdge& other) const {
    return low == other.low && high == other.high;
  }
};

std::vector<HalfEdge> sorted_half_edges(const ConstTriangles& triangles) {
  std::vector<HalfEdge> edges;
  edges.reserve(static_cast<std::size_t>(3 * triangles.cols()));
  for (Index t = 0; t < triangles.cols(); ++t) {
    for (int side = 0; side < 3; ++side) {
      const std::int32_t a = triangles(side, t);
      const std::int32_t b = triangles((side + 1) % 3, t);
      edges.push_back({std::min(a, b), std::max(a, b), static_cast<std::int32_t>(t), side, a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.triangle, a.side) <
           std::tie(b.low, b.high, b.triangle, b.side);
  });
  return edges;
}

}  // namespace

Adjacency adjacency(const ConstTriangles& triangles) {
  Adjacency result;
  result.across.assign(static_cast<std::size_t>(triangles.cols()), {kBorder, kBorder, kBorder});
  const std::vector<HalfEdge> edges = sorted_half_edges(triangles);
  const auto across = [&](const HalfEdge& edge) -> std::int32_t& {
    return result
        .across[static_cast<std::size_t>(edge.triangle)][static_cast<std::size_t>(edge.side)];
  };
  for (std::size_t begin = 0; begin < edges.size();) {
    std::size_t end = begin + 1;
    while (end < edges.size() && edges[end].same_edge(edges[begin])) ++end;
    if (end - begin == 2 && edges[begin].ascending != edges[begin + 1].ascending) {
      across(edges[begin]) = edges[begin + 1].triangle;
      across(edges[begin + 1]) = edges[begin].triangle;
    } else if (end - begin > 1) {
      ++result.non_manifold_edges;
      for (std::size_t i = begin; i < end; ++i) across(edges[i]) = kNonManifold;
    }
    begin = end;
  }
  return result;
}

Components components(const Adjacency& adjacency) {
  Components result;
  result.of.assign(adjacency.across.size(), -1);
  std::vector<std::size_t> stack;
  for (std::size_t first = 0; first < result.of.size(); ++first) {
    if (result.of[first] >= 0) continue;
    stack.push_back(first);
    result.of[first] = result.count;
    while (!stack.empty()) {
      const std::size_t t = stack.back();
      stack.pop_back();
      for (const std::int32_t next : adjacency.across[t]) {
        if (next < 0 || result.of[static_cast<std::size_t>(next)] >= 0) continue;
        result.of[static_cast<std::size_t>(next)] = result.count;
        stack.push_back(static_cast<std::size_t>(next));
      }
    }
    ++result.count;
  }
  return result;
}

std::vector<std::vector<std::int32_t>> border_loops(const ConstTriangles& triangles,
                                                    const Adjacency& adjacency) {
  std::multimap<std::int32_t, std::int32_t> next;  // ordered, so that the walk is deterministic
  for (Index t = 0; t < triangles.cols(); ++t)
    for (int side = 0; side < 3; ++side)
      if (adjacency.across[static_cast<std::size_t>(t)][static_cast<std::size_t>(side)] == kBorder)
        next.emplace(triangles(side, t), triangles((side + 1) % 3, t));

  std::vector<std::vector<std::int32_t>> loops;
  while (!next.empty()) {
    std::vector<std::int32_t> walk{next.begin()->first};
    std::unordered_map<std::int32_t, std::size_t> place{{walk.front(), 0}};
    for (auto edge = next.begin(); edge != next.end(); edge = next.find(walk.back())) {
      const std::int32_t to = edge->second;
      next.erase(edge);
      const auto [seen, is_new] = place.try_emplace(to, walk.size());
      if (is_new) {
        walk.push_back(to);
        continue;
      }
      const auto begin = walk.begin() + static_cast<std::ptrdiff_t>(seen->second);
      loops.emplace_back(begin, walk.end());
      for (auto vertex = begin + 1; vertex != walk.end(); ++vertex) place.erase(*vertex);
      walk.erase(begin + 1, walk.end());
    }
    // An open walk is left only where edges are not manifold; it is no border.
  }
  for (auto& loop : loops)
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  std::sort(loops.begin(), loops.end(), [](const auto& a, const auto& b) {
    return std::tuple(b.size(), a.front()) < std::tuple(a.size(), b.front());
  });
  return loops;
}

Index pinched_vertices(const ConstTriangles& triangles, const Adjacency& adjacency) {
  // Corners of triangles, joined across the edges that they share at their vertex: one set a fan.
  const auto corners = static_cast<std::size_t>(3 * triangles.cols());
  std::vector<std::size_t> parent(corners);
  for (std::size_t i = 0; i < corners; ++i) parent[i] = i;
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const auto corner = [&](std::int32_t triangle, std::int32_t vertex) {
    int side = 0;
    while (triangles(side, triangle) != vertex) ++side;
    return static_cast<std::size_t>(3 * triangle + side);
  };
  std::vector<Index> fans(corners == 0 ? 0 : static_cast<std::size_t>(triangles.maxCoeff()) + 1, 0);
  for (Index t = 0; t < triangles.cols(); ++t)
    for (int side = 0; side < 3; ++side) ++fans[static_cast<std::size_t>(triangles(side, t))];
  for (Index t = 0; t < triangles.cols(); ++t) {
    for (int side = 0; side < 3; ++side) {
      const std::int32_t other =
          adjacency.across[static_cast<std::size_t>(t)][static_cast<std::size_t>(side)];
      if (other < 0) continue;
      for (const std::int32_t v : {triangles(side, t), triangles((side + 1) % 3, t)}) {
        const std::size_t a = root(corner(static_cast<std::int32_t>(t), v));
        const std::size_t b = root(corner(other, v));
        if (a == b) continue;
        parent[std::max(a, b)] = std::min(a, b);
        --fans[static_cast<std::size_t>(v)];
      }
    }
  }
  return std::count_if(fans.begin(), fans.end(), [](Index n) { return n > 1; });
}

double loop_length(const ConstPoints& positions, const std::vector<std::int32_t>& loop) {
  double length = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto a = positions.col(loop[i]).cast<double>();
    const auto b = positions.col(loop[(i + 1) % loop.size()]).cast<double>();
    length += (a - b).norm();
  }
  return length;
}

}  // namespace velum::mesh
