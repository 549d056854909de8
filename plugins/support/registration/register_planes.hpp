// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "registration/icp.hpp"
#include "velum/cloud.hpp"
#include "velum/context.hpp"

namespace velum::registration {

/// A point on a plane of the source and one on the same plane as the target sees it, true
/// positions.
struct PlanePick {
  Eigen::Vector3d source;
  Eigen::Vector3d target;
};

struct PlanesOptions {
  double cell = 0.0;            ///< of the search for planes [m]; 0: from the clouds
  double least_overlap = 0.05;  ///< of the source with the target
  double least_gap = 0.1;       ///< between the evidence for the best pose and for the next one
  double most_deviation = 0.0;  ///< of the pose along its weakest direction [m]; 0: no limit
  std::vector<PlanePick> picks;
};

struct PlanesResult {
  Pose pose = Pose::Identity();  ///< relative to the clouds' origins
  std::vector<IcpStep> steps;
  int matched = 0;      ///< planes
  int candidates = 0;   ///< assignments that were looked at
  double gap = 0.0;     ///< evidence for this pose less that for the next one
  double agrees = 0.0;  ///< see Evidence
  double blocked = 0.0;
  double overlap = 0.0;    ///< share of the source near the target
  double fitness = 0.0;    ///< mean squared distance of these [m²]
  double sigma = 0.0;      ///< RMS gap, point to plane [m]
  double plane_gap = 0.0;  ///< RMS distance between matched planes at their centres [m]
  NormalEquations::Deviations deviations{};  ///< standard deviations of the pose, worst direction
  Vector6 weakest;                           ///< that direction: turn (as arc), shift
};

/// Algorithm 3.2 of the thesis without its user: planes of both clouds, every assignment that fits,
/// the one that the rest of the scene and the lines of sight bear out, refined by point to plane.
/// Throws Error(Fault::stage) instead of returning a pose that is not borne out.
PlanesResult register_planes(const Cloud& source, const Cloud& target, const PlanesOptions& options,
                             Context& context);

}  // namespace velum::registration
