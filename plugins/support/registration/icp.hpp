// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

#include "registration/normal_equations.hpp"
#include "velum/cloud.hpp"
#include "velum/context.hpp"
#include "velum/table.hpp"

namespace velum::registration {

enum class Metric { point_to_point, point_to_plane };

struct IcpOptions {
  Metric metric = Metric::point_to_point;
  double max_distance = std::numeric_limits<double>::infinity();  ///< of a pair [m]
  double keep = 1.0;    ///< share of the pairs that counts, the nearest ones
  int iterations = 25;  ///< at each level
  double relative_change = 1e-3;
  int levels = 1;  ///< level l from the last uses every 4^l-th source point
};

/// One iteration: what was found at its start, and the motion that it made.
struct IcpStep {
  Index pairs = 0;
  double error = 0.0;            ///< mean squared gap by the metric [m²]
  double relative_change = 0.0;  ///< of the error since the step before; NaN at a level's first
  double rotation = 0.0;         ///< [rad]
  double translation = 0.0;      ///< of the barycentre [m]
  Eigen::Vector3d barycentre = Eigen::Vector3d::Zero();  ///< of the source after it, true position
};

struct IcpResult {
  Pose pose = Pose::Identity();  ///< source → target, of coordinates relative to their origins
  std::vector<IcpStep> steps;
  int iterations = 0;
  bool converged = false;  ///< by the change of the error, not the number of iterations
  Index pairs = 0;
  double fitness = 0.0;                    ///< mean squared distance of the pairs at the end [m²]
  double overlap = 0.0;                    ///< share of the source points that have a pair
  NormalEquations::Directions directions;  ///< how well each direction is fixed
};

/// Algorithm 3.1 of the thesis (Besl and McKay 1992; Chen and Medioni 1991) from `start`. Point to
/// plane needs normals of the target. Throws Error(Fault::stage) when too few pairs are near
/// enough.
IcpResult icp(const Cloud& source, const Cloud& target, const Pose& start,
              const IcpOptions& options, Context& context);

/// The steps as the stages' `table` output.
Table history_table(const std::vector<IcpStep>& steps);

}  // namespace velum::registration
