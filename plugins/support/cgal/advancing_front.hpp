// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace velum::cgal {

struct FrontRules {
  double radius_ratio = 5.0;  ///< candidates that are this much larger than their neighbour go
  double beta = 0.52;         ///< half the wedge in which only the radius counts [rad]
  double max_edge = 0.0;      ///< longest edge; 0: any
};

/// Triangles of the surface that CGAL's advancing front grows over `points`, oriented alike in each
/// of its parts, in ascending order. The order in which edges of the front that reach one triangle
/// at once are served depends on memory: a few triangles can differ from run to run. Throws
/// std::exception where CGAL finds itself in disorder.
std::vector<std::array<std::int32_t, 3>> advancing_front(const Eigen::Matrix3Xd& points,
                                                         const FrontRules& rules);

}  // namespace velum::cgal
