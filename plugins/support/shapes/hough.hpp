// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "shapes/ransac.hpp"

namespace velum::shapes {

struct Votes {
  Index samples = 20000;  ///< triples of near points that may vote for a sphere
  double bin = 0.0;       ///< edge of the cells in which votes for spheres meet [m]
};

/// Planes and spheres by a Hough transform, one after another. Planes: an octree cuts the cloud
/// into flat patches, each votes for its own plane with a kernel as wide as its plane is uncertain,
/// and the accumulator is evaluated where votes lie (after Limberger and Oliveira 2015). Spheres:
/// near triples of points with normals vote for centre and radius in a sparse grid (randomised,
/// after Xu et al. 1990). The highest peak is fitted to its voters, takes the points that agree,
/// and their votes are taken back. `search.kinds` may hold plane and sphere.
Detection find_by_votes(const Cloud& cloud, const Search& search, const Votes& votes,
                        Context& context);

}  // namespace velum::shapes
