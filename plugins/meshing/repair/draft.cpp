// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "draft.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "mesh/build.hpp"

namespace velum::meshing {
namespace {

using mesh::Triangle;

/// One side of a triangle: from its vertex `side` to the next.
struct Side {
  std::int32_t low, high, triangle, side;
  bool ascending;
};

std::vector<Side> sorted_sides(const std::vector<Triangle>& triangles) {
  std::vector<Side> sides;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = triangles[t][i];
      const std::int32_t b = triangles[t][(i + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<std::int32_t>(t),
                       static_cast<std::int32_t>(i), a < b});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return sides;
}

/// Direction from the edge into the triangle, square to the edge.
Eigen::Vector3d inwards(const Draft& draft, const Side& s) {
  const Triangle& t = draft.triangles[static_cast<std::size_t>(s.triangle)];
  const Eigen::Vector3d low = draft.positions.col(s.low);
  const Eigen::Vector3d edge = (draft.positions.col(s.high) - low).normalized();
  const Eigen::Vector3d to_apex =
      draft.positions.col(t[static_cast<std::size_t>((s.side + 2) % 3)]) - low;
  return (to_apex - to_apex.dot(edge) * edge).normalized();
}

/// Of the sides [begin, end) of one edge the two that stay joined: those that fold least.
std::pair<std::size_t, std::size_t> flattest(const Draft& draft, const std::vector<Side>& sides,
                                             std::size_t begin, std::size_t end) {
  std::pair<std::size_t, std::size_t> best{begin, begin + 1};
  double least = 2.0;
  for (std::size_t i = begin; i < end; ++i)
    for (std::size_t j = i + 1; j < end; ++j) {
      const double fold = inwards(draft, sides[i]).dot(inwards(draft, sides[j]));
      if (fold < least) {
        least = fold;
        best = {i, j};
      }
    }
  return best;
}

/// Corners of triangles (3 a triangle) in sets that share a vertex.
class Fans {
 public:
  explicit Fans(const std::vector<Triangle>& triangles) : triangles_(triangles) {
    for (std::size_t i = 0; i < 3 * triangles.size(); ++i) parent_.push_back(i);
  }
  /// Both triangles keep the vertices of their common edge in common.
  void join(const Side& a, const Side& b) {
    for (const std::int32_t v : {a.low, a.high}) {
      const std::size_t x = root(corner(a.triangle, v));
      const std::size_t y = root(corner(b.triangle, v));
      parent_[std::max(x, y)] = std::min(x, y);
    }
  }
  std::size_t root(std::size_t corner) {
    while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
    return corner;
  }

 private:
  [[nodiscard]] std::size_t corner(std::int32_t triangle, std::int32_t vertex) const {
    const Triangle& t = triangles_[static_cast<std::size_t>(triangle)];
    const auto at = std::find(t.begin(), t.end(), vertex) - t.begin();
    return 3 * static_cast<std::size_t>(triangle) + static_cast<std::size_t>(at);
  }
  const std::vector<Triangle>& triangles_;
  std::vector<std::size_t> parent_;
};

/// Gives each fan but the first at a vertex a vertex of its own.
Index separate(Draft& draft, Fans& fans) {
  std::map<std::pair<std::int32_t, std::size_t>, std::int32_t> vertex_of;
  std::vector<char> taken(draft.source.size(), 0);
  const auto before = static_cast<Index>(draft.source.size());
  std::vector<Triangle> made = draft.triangles;
  for (std::size_t t = 0; t < made.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t v = draft.triangles[t][i];
      const auto [place, is_new] = vertex_of.try_emplace({v, fans.root(3 * t + i)}, v);
      if (is_new && taken[static_cast<std::size_t>(v)] != 0) place->second = draft.twin(v);
      taken[static_cast<std::size_t>(v)] = 1;
      made[t][i] = place->second;
    }
  draft.triangles = std::move(made);
  return static_cast<Index>(draft.source.size()) - before;
}

/// Calls visit(begin, end) for the sides of each edge that has several.
template <class Visit>
void each_shared(const std::vector<Side>& sides, const Visit& visit) {
  for (std::size_t begin = 0; begin < sides.size();) {
    std::size_t end = begin + 1;
    while (end < sides.size() && sides[end].low == sides[begin].low &&
           sides[end].high == sides[begin].high)
      ++end;
    if (end - begin > 1) visit(begin, end);
    begin = end;
  }
}

Index split(Draft& draft, bool conflicts) {
  const std::vector<Side> sides = sorted_sides(draft.triangles);
  Fans fans(draft.triangles);
  each_shared(sides, [&](std::size_t begin, std::size_t end) {
    const auto [a, b] = flattest(draft, sides, begin, end);
    if (!conflicts || sides[a].ascending != sides[b].ascending) fans.join(sides[a], sides[b]);
  });
  return separate(draft, fans);
}

/// Drops the triangles at edges that still have more than two, since the fans at both ends of the
/// edge hang together elsewhere.
bool drop_extra(Draft& draft) {
  const std::vector<Side> sides = sorted_sides(draft.triangles);
  std::vector<char> extra(draft.triangles.size(), 0);
  each_shared(sides, [&](std::size_t begin, std::size_t end) {
    if (end - begin == 2) return;
    const auto [a, b] = flattest(draft, sides, begin, end);
    for (std::size_t i = begin; i < end; ++i)
      if (i != a && i != b) extra[static_cast<std::size_t>(sides[i].triangle)] = 1;
  });
  std::size_t kept = 0;
  for (std::size_t t = 0; t < draft.triangles.size(); ++t)
    if (extra[t] == 0) draft.triangles[kept++] = draft.triangles[t];
  const bool dropped = kept < draft.triangles.size();
  draft.triangles.resize(kept);
  return dropped;
}

}  // namespace

Draft::Draft(const Mesh& mesh)
    : positions(mesh.positions().cast<double>()),
      triangles(mesh::triangles_of(mesh)),
      source(static_cast<std::size_t>(mesh.vertices().size())) {
  std::iota(source.begin(), source.end(), 0);
}

std::int32_t Draft::twin(std::int32_t vertex) {
  const auto made = static_cast<std::int32_t>(source.size());
  source.push_back(source[static_cast<std::size_t>(vertex)]);
  if (positions.cols() <= made) positions.conservativeResize(3, 2 * made + 1);
  positions.col(made) = positions.col(vertex);
  return made;
}

void drop_doubles(Draft& draft) {
  std::set<Triangle> seen;
  std::vector<Triangle> kept;
  for (const Triangle& t : draft.triangles) {
    Triangle key = t;
    std::sort(key.begin(), key.end());
    if (key[0] != key[1] && key[1] != key[2] && seen.insert(key).second) kept.push_back(t);
  }
  draft.triangles = std::move(kept);
}

Index split_non_manifold(Draft& draft) {
  Index made = split(draft, false);
  while (drop_extra(draft)) made += split(draft, false);
  return made;
}

Index split_conflicts(Draft& draft) {
  return split(draft, true);
}

}  // namespace velum::meshing
