// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geometry/find_planes.hpp"

/// Parts of find_planes: the cells of a thinned cloud, and planes grown over them.
namespace velum::geometry {

/// Neighbours of a cell, itself among them.
inline constexpr Index kCellNeighbours = 13;
/// Cells farther than this share of their edge from a plane are not of it while it grows.
inline constexpr double kPlaneTolerance = 0.25;

/// A thinned cloud, a point a cell, with normals and curvature.
struct PlaneCells {
  Cloud cloud;
  double edge = 0.0;
  std::vector<std::int32_t> near;  ///< kCellNeighbours a cell, -1 where there are fewer
  std::vector<Eigen::Vector3f> normals;
  std::vector<float> curvature;

  [[nodiscard]] Eigen::Vector3d mean(std::int32_t c) const {
    return cloud.positions().col(c).cast<double>();
  }
};

[[nodiscard]] PlaneCells make_plane_cells(Points means, double edge, Context& context);

/// Planes as lists of at least `least` cells, grown from the flattest cells on; no cell is in two.
[[nodiscard]] std::vector<std::vector<std::int32_t>> grow_planes(const PlaneCells& cells,
                                                                 double angle, std::size_t least,
                                                                 Context& context);

/// A plane and the cells that it was grown over.
struct GrownPlane {
  PlaneFit fit;
  std::vector<std::int32_t> cells;
};

/// Each region's plane, settled by RANSAC (thesis 3.3.2) and least squares; parts of one plane (a
/// wall behind a mast) become one; largest first.
[[nodiscard]] std::vector<GrownPlane> join_planes(const PlaneCells& cells,
                                                  std::vector<std::vector<std::int32_t>> regions);

}  // namespace velum::geometry
