// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geometry/plane_fit.hpp"
#include "velum/cloud.hpp"
#include "velum/context.hpp"

namespace velum::geometry {

/// A flat part of a scene.
struct ScenePlane {
  PlaneFit fit;  ///< relative to the cloud's origin; the normal faces the sensor
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of its points [m²]
  Index points = 0;
  double area = 0.0;  ///< [m²], roughly
};

struct PlaneSearch {
  double cell = 0.0;        ///< edge of the cells that are grown [m]; 0: from the cloud
  double angle = 0.175;     ///< most that a cell's normal may differ from its plane's [rad]
  double min_share = 0.01;  ///< of all cells that a plane must have
  Index max_planes = 12;    ///< the largest ones
};

struct ScenePlanes {
  std::vector<ScenePlane> planes;      ///< by area, largest first
  std::vector<std::int32_t> plane_of;  ///< of each point; -1 for the rest
  double cell = 0.0;                   ///< as used [m]
};

/// Walls, floor, ceiling: planes grown over a thinned copy of the cloud (so that far walls with few
/// points count as much as near ones), settled by RANSAC within each region, joined where they are
/// parts of one plane, and fitted to all their points. Normals face the sensor that saw the plane;
/// in a cloud without sensors, the origin of the axes. Planes much smaller than `min_share`, and
/// curved sheets, are left to the rest.
ScenePlanes find_planes(const Cloud& cloud, const PlaneSearch& search, Context& context);

}  // namespace velum::geometry
