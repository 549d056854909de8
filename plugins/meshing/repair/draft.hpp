// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/mesh.hpp>

#include "mesh/topology.hpp"

namespace velum::meshing {

/// A mesh that is worked on. Each vertex knows the vertex of the input that it comes from.
struct Draft {
  Eigen::Matrix3Xd positions;
  std::vector<mesh::Triangle> triangles;
  std::vector<std::int32_t> source;

  explicit Draft(const Mesh& mesh);
  /// Another vertex at the same place; its number.
  std::int32_t twin(std::int32_t vertex);
};

/// Removes triangles that name a vertex twice, and all but the first of those over the same three
/// vertices.
void drop_doubles(Draft& draft);

/// Cuts the mesh so that it is manifold: of the triangles at an edge of more than two, the two that
/// fold least stay joined; then each fan of
/// triangles at a vertex gets a vertex of its own. Where that is not enough the others are dropped.
/// Returns how many vertices were made.
Index split_non_manifold(Draft& draft);

/// Cuts apart the neighbours that run along their edge the same way: after orientation, those of a
/// Möbius strip. Returns how many vertices were made.
Index split_conflicts(Draft& draft);

/// What closing holes came to.
struct Closed {
  Index holes = 0;      ///< closed
  Index left_open = 0;  ///< short enough, but no triangles fit in
};

/// Closes each border that is at most `longest` [m], the longest one of each part excepted, with
/// the triangles of least area over its vertices (Barequet and Sharir, CAGD 12, 1995).
Closed close_holes(Draft& draft, double longest);

}  // namespace velum::meshing
