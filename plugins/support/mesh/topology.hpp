// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>
#include <velum/mesh.hpp>

/// How the triangles of a mesh hang together.
namespace velum::mesh {

using Triangle = std::array<std::int32_t, 3>;

/// What lies across edge i of a triangle, which runs from its vertex i to its vertex i + 1.
inline constexpr std::int32_t kBorder = -1;  ///< nothing: the edge is on the border
inline constexpr std::int32_t kNonManifold =
    -2;  ///< several triangles, or one turned the other way

/// Neighbour triangles of each triangle, and what is wrong with them.
struct Adjacency {
  std::vector<Triangle> across;
  /// Edges with more than two triangles, or two that run the same way.
  Index non_manifold_edges = 0;
};
Adjacency adjacency(const ConstTriangles& triangles);

/// A number for each triangle: triangles that share an edge have the same; from 0 in the order of
/// their first triangle.
struct Components {
  std::vector<std::int32_t> of;
  std::int32_t count = 0;
};
Components components(const Adjacency& adjacency);

/// Vertices around each border, in the direction of the triangles' edges, starting at the smallest
/// vertex; longest border first (by number of vertices, then by first vertex). A border that
/// touches itself at a vertex is cut there into loops.
std::vector<std::vector<std::int32_t>> border_loops(const ConstTriangles& triangles,
                                                    const Adjacency& adjacency);

/// Vertices at which the triangles form more than one fan (two sheets that touch at a point).
Index pinched_vertices(const ConstTriangles& triangles, const Adjacency& adjacency);

/// Length of the closed polygon through `loop` [m].
double loop_length(const ConstPoints& positions, const std::vector<std::int32_t>& loop);

}  // namespace velum::mesh
