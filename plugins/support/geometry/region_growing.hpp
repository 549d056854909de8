// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>
#include <velum/cloud.hpp>
#include <velum/context.hpp>

namespace velum::geometry {

/// Parameters of Algorithm 3.5 with the thesis's names.
struct GrowingOptions {
  Index neighbours = 50;
  double smoothness = 0.122;                           ///< θ_th [rad]
  double curvature = 0.05;                             ///< c_th; above 1/3 every point is a seed
  Index min_size = 1;                                  ///< N_min
  Index max_size = std::numeric_limits<Index>::max();  ///< N_max
};

struct Regions {
  /// Region of each point, -1 for none; regions are numbered from the largest to the smallest.
  Eigen::VectorXi labels;
  std::vector<Index> sizes;
  /// Surface area that each point stands for [m²], from the density around it.
  Eigen::VectorXf areas;
  Index largest = 0;    ///< points of the largest region grown, accepted or not
  Index too_small = 0;  ///< regions refused because of min_size; those of rough points not counted
  Index too_large = 0;  ///< and because of max_size
};

/// Region growing (thesis 3.3.3, Algorithm 3.5) over the columns normals and curvature. Seeds are
/// taken in order of (curvature, index), so the result is one and the same on every machine. The
/// angle between normals ignores their sign, as in the thesis: a sheet seen by two scanners from
/// both sides is one region.
Regions grow_regions(const Cloud& cloud, const GrowingOptions& options, Context& context);

}  // namespace velum::geometry
