// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <numbers>
#include <vector>

#include "registration/uncertainty.hpp"
#include "velum/cloud.hpp"
#include "velum/context.hpp"
#include "velum/table.hpp"

namespace velum::registration {

/// What is minimised: distances of the pairs, from the target's tangent planes, or from planes
/// between both (Rusinkiewicz 2019).
enum class Metric { point_to_point, point_to_plane, symmetric };
/// How a step's motion is found. Automatic: svd for point to point, helical for the others.
enum class Solver { automatic, svd, linearised, helical };
enum class Pairing { nearest, reciprocal };
enum class Sampling { all, random, curvature };
enum class Kernel { none, huber, tukey };

struct IcpOptions {
  Metric metric = Metric::point_to_point;
  double max_distance = std::numeric_limits<double>::infinity();  ///< of a pair [m]
  double keep = 1.0;    ///< share of the pairs that counts, the nearest ones
  int iterations = 25;  ///< at each level
  double relative_change = 1e-3;
  int levels = 1;  ///< level l from the last uses every 4^l-th source point
  Solver solver = Solver::automatic;
  Pairing pairing = Pairing::nearest;
  /// Between the normals of a pair that counts [rad]; π and more: not asked.
  double normal_angle = std::numbers::pi;
  Sampling sampling = Sampling::all;
  double sample = 0.1;  ///< share of the source that sampling takes
  Kernel kernel = Kernel::none;
  double kernel_scale = 0.0;  ///< one standard deviation [m]; 0: from the pairs, at each step
  /// A step that turns [rad] and shifts the barycentre [m] by less than these ends it; both 0: not
  /// asked.
  double still_rotation = 0.0;
  double still_translation = 0.0;
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
  bool converged = false;  ///< by the change of the error or the motion, not the iterations
  Index pairs = 0;
  double fitness = 0.0;  ///< mean squared distance of the pairs at the end [m²]
  double overlap = 0.0;  ///< share of the source points that have a pair
  Uncertainty uncertainty;
};

/// Algorithm 3.1 of the thesis (Besl and McKay 1992; Chen and Medioni 1991) from `start`. Point to
/// plane needs normals of the target, the symmetric metric and `normal_angle` those of both, and
/// sampling by curvature the source's `curvature`. Throws Error(Fault::stage) when too few pairs
/// are near enough.
IcpResult icp(const Cloud& source, const Cloud& target, const Pose& start,
              const IcpOptions& options, Context& context);

/// The steps as the stages' `table` output.
Table history_table(const std::vector<IcpStep>& steps);

}  // namespace velum::registration
