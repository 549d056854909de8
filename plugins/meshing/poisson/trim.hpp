// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/context.hpp>
#include <velum/mesh.hpp>

#include "mesh/topology.hpp"

namespace velum::meshing {

/// Vertices and triangles that are still worked on.
struct Draft {
  Points positions;
  std::vector<mesh::Triangle> triangles;
};

/// Where a surface still belongs to the points that it was made from.
struct Support {
  double max_distance = 0.0;  ///< farthest from the nearest point [m]; 0: any
  double min_density = 0.0;   ///< least density of points, of the usual one around; 0: any
};

/// How far inside its support each vertex is; negative outside, zero at the border. The density at
/// a place is that of the disc through its twelfth point, the usual one that of the same points'
/// own discs: a share of 1 inside, about 0.7 at a straight border, less beyond it and in corners.
Eigen::VectorXd margins(const Points& vertices, const Cloud& cloud, const Support& support,
                        Context& context);

/// Cuts triangles along the line where the margin is zero and keeps what is inside.
void cut(Draft& draft, const Eigen::VectorXd& margins);

}  // namespace velum::meshing
