// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/context.hpp>
#include <velum/mesh.hpp>

#include "mesh/topology.hpp"

namespace velum::meshing {

/// What trimming works on and how far it goes. Lengths are of the true triangles, not of their
/// projection.
struct TrimRules {
  /// Spacing of the points around each vertex [m].
  Eigen::VectorXf spacing;
  /// Longest edge [m]; 0: six times the spacing around its ends.
  double max_edge = 0.0;
};

/// Distance to the sixth neighbour [m]: 1.4 times the spacing of an even cloud, twice it at a
/// border; unlike the nearest neighbour it is not fooled by two scans that overlap.
Eigen::VectorXf local_spacing(const Cloud& cloud, Context& context);

/// Removes triangles with too long an edge, then all but the largest part, then triangles that hang
/// on it by a vertex alone. What is left is one manifold sheet.
void remove_long(std::vector<mesh::Triangle>& triangles, const ConstPoints& positions,
                 const TrimRules& rules);

/// Removes the slivers that the convex hull leaves over a curved border: from the outside inwards,
/// flattest first, triangles that turn their longest edge out and whose circumradius is far above
/// the spacing. No vertex is lost, and one border stays one border (after the characteristic shapes
/// of Duckham et al., Pattern Recognition 41, 2008).
void peel_slivers(std::vector<mesh::Triangle>& triangles, const ConstPoints& positions,
                  const TrimRules& rules);

}  // namespace velum::meshing
