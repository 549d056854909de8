// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "velum/cloud.hpp"

namespace velum::geometry {

/// One point for each occupied cell of a cubic grid: the mean of those inside.
struct Thinned {
  Points means;                       ///< relative to the cloud's origin
  std::vector<std::int32_t> cell_of;  ///< cell of each point given
  std::vector<std::int32_t> counts;   ///< points in each cell
  double cell = 0.0;                  ///< edge length [m]
};

/// Cells of edge `cell` [m] (longer where the extent would need more than 2²¹ of them).
Thinned thin(const ConstPoints& positions, double cell);

/// The edge length that leaves about `wanted` cells of points that lie on surfaces; 0 when all
/// points are in one place.
double cell_for(const ConstPoints& positions, Index wanted);

}  // namespace velum::geometry
