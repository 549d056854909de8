// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>
#include <velum/mesh.hpp>

#include "mesh/topology.hpp"

/// From triangles over a cloud to a mesh of it.
namespace velum::mesh {

/// What `orient` found.
struct Orientation {
  Index parts = 0;      ///< sets of triangles joined by edges of exactly two
  Index turned = 0;     ///< triangles that were turned
  Index conflicts = 0;  ///< edges whose two triangles cannot agree (a Möbius strip)
};

/// Turns triangles so that neighbours across an edge of exactly two agree, in each part as its
/// first triangle has it; then each part, if its vertices were seen by sensors, so that most of its
/// area looks at them.
Orientation orient(std::vector<Triangle>& triangles, const Cloud& cloud);

/// Keeps the parts (triangles joined by edges) that have at least `share` of the largest part's
/// area; 1 keeps the largest alone. Returns how many parts went.
Index keep_parts(std::vector<Triangle>& triangles, const ConstPoints& positions, double share);

/// The mesh of these triangles over those points of the cloud that they use, in the cloud's order,
/// with all their columns.
Mesh mesh_over(const std::vector<Triangle>& triangles, const Cloud& cloud);

/// The triangles of a mesh, to be worked on.
std::vector<Triangle> triangles_of(const Mesh& mesh);

/// A view of triangles in the form in which the functions of topology.hpp take them.
ConstTriangles view(const std::vector<Triangle>& triangles);

/// Twice the area of the triangle, as a vector along its normal.
Eigen::Vector3d area_vector(const Triangle& t, const ConstPoints& positions);

/// For each point the smallest index of the points at the same place: points that are first there
/// have their own.
std::vector<std::int32_t> first_of_equal(const ConstPoints& positions);

}  // namespace velum::mesh
