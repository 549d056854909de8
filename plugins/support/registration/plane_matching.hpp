// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "geometry/find_planes.hpp"

namespace velum::registration {

/// One plane of the source and the plane of the target that it is.
struct PlaneMatch {
  int source;
  int target;
};

/// A way in which the planes of two clouds may be the same planes.
struct Assignment {
  std::vector<PlaneMatch> matches;
  Pose pose = Pose::Identity();  ///< source → target, relative to their origins
  /// Directions of the target's frame in which the planes fix no shift; empty, one or two.
  std::vector<Eigen::Vector3d> free;
  double support = 0.0;  ///< area of the matched planes [m²], the smaller of each pair
};

struct MatchOptions {
  double angle = 0.035;           ///< between the normals of planes that are the same [rad]
  double offset = 0.05;           ///< between their positions [m]
  std::vector<PlaneMatch> picks;  ///< matches that must hold
};

/// Every assignment in which planes that both clouds saw from within coincide: turned by all
/// rotations that carry two planes of the source onto two of the target, shifted by all offsets
/// that agree. All normals of an assignment are solved together (orthogonal Procrustes, weighted by
/// area), not one wall after the other. Best supported first; assignments of far less support than
/// the best one are left out.
std::vector<Assignment> match_planes(const std::vector<geometry::ScenePlane>& source,
                                     const std::vector<geometry::ScenePlane>& target,
                                     const MatchOptions& options);

}  // namespace velum::registration
