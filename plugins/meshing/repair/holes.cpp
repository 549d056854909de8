// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "draft.hpp"
#include "mesh/build.hpp"

namespace velum::meshing {
namespace {

using mesh::Triangle;
using Loop = std::vector<std::int32_t>;

/// The work grows with the third power of a hole's vertices.
constexpr std::size_t kLargestHole = 400;

double length_of(const Draft& draft, const Loop& loop) {
  double length = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i)
    length +=
        (draft.positions.col(loop[i]) - draft.positions.col(loop[(i + 1) % loop.size()])).norm();
  return length;
}

using Edges = std::set<std::pair<std::int32_t, std::int32_t>>;

Edges edges_of(const std::vector<Triangle>& triangles) {
  Edges edges;
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
  return edges;
}

/// Least area of the triangles over loop[i] ... loop[j], and the corner that the one over the edge
/// (i, j) has in between.
class LeastArea {
 public:
  LeastArea(const Draft& draft, const Loop& loop, const Edges& edges)
      : draft_(draft),
        loop_(loop),
        edges_(edges),
        n_(loop.size()),
        area_(n_ * n_, 0.0),
        corner_(n_ * n_, 0) {
    for (std::size_t span = 2; span < n_; ++span)
      for (std::size_t i = 0; i + span < n_; ++i) choose(i, i + span);
  }
  [[nodiscard]] bool found() const { return area_[n_ - 1] < std::numeric_limits<double>::max(); }
  /// Triangles that continue the mesh: the loop runs along its triangles' edges, they against it.
  void emit(std::vector<Triangle>& triangles) const { emit(0, n_ - 1, triangles); }

 private:
  void choose(std::size_t i, std::size_t j) {
    double best = std::numeric_limits<double>::max();
    const bool inner = i != 0 || j != n_ - 1;
    if (!inner || edges_.count(std::minmax(loop_[i], loop_[j])) == 0) {
      for (std::size_t k = i + 1; k < j; ++k) {
        if (std::max(area_[i * n_ + k], area_[k * n_ + j]) == std::numeric_limits<double>::max())
          continue;
        const double total = area_[i * n_ + k] + area_[k * n_ + j] + area(i, k, j);
        if (total < best) {
          best = total;
          corner_[i * n_ + j] = k;
        }
      }
    }
    area_[i * n_ + j] = best;
  }
  [[nodiscard]] double area(std::size_t i, std::size_t k, std::size_t j) const {
    const Eigen::Vector3d a = draft_.positions.col(loop_[i]);
    return (draft_.positions.col(loop_[k]) - a).cross(draft_.positions.col(loop_[j]) - a).norm();
  }
  void emit(std::size_t i, std::size_t j, std::vector<Triangle>& triangles) const {
    if (j - i < 2) return;
    const std::size_t k = corner_[i * n_ + j];
    triangles.push_back({loop_[i], loop_[j], loop_[k]});
    emit(i, k, triangles);
    emit(k, j, triangles);
  }

  const Draft& draft_;
  const Loop& loop_;
  const Edges& edges_;
  std::size_t n_;
  std::vector<double> area_;
  std::vector<std::size_t> corner_;
};

/// Borders of each part except its longest.
std::vector<Loop> holes_of(const Draft& draft) {
  const ConstTriangles triangles = mesh::view(draft.triangles);
  const mesh::Adjacency adjacency = mesh::adjacency(triangles);
  const mesh::Components parts = mesh::components(adjacency);
  std::map<std::int32_t, std::int32_t> part_of;
  for (std::size_t t = 0; t < draft.triangles.size(); ++t)
    for (const std::int32_t v : draft.triangles[t]) part_of[v] = parts.of[t];
  std::vector<Loop> loops = mesh::border_loops(triangles, adjacency);
  std::map<std::int32_t, std::pair<double, std::size_t>> longest;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    auto& [length, number] = longest[part_of.at(loops[i].front())];
    const double here = length_of(draft, loops[i]);
    if (here > length) {
      length = here;
      number = i;
    }
  }
  std::vector<Loop> holes;
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (longest.at(part_of.at(loops[i].front())).second != i) holes.push_back(loops[i]);
  return holes;
}

}  // namespace

Closed close_holes(Draft& draft, double longest) {
  Closed closed;
  Edges edges = edges_of(draft.triangles);
  for (const Loop& hole : holes_of(draft)) {
    if (length_of(draft, hole) > longest) continue;
    if (hole.size() < 3 || hole.size() > kLargestHole) {
      ++closed.left_open;
      continue;
    }
    const LeastArea patch(draft, hole, edges);
    if (!patch.found()) {
      ++closed.left_open;
      continue;
    }
    std::vector<Triangle> made;
    patch.emit(made);
    edges.merge(edges_of(made));
    draft.triangles.insert(draft.triangles.end(), made.begin(), made.end());
    ++closed.holes;
  }
  return closed;
}

}  // namespace velum::meshing
