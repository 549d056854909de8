// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "registration/icp.hpp"

namespace velum::registration {

struct PfhIcpOptions {
  double max_distance = 0.0;  ///< of a pair at the start [m]; 0: a third of the source's diagonal
  double cell = 0.0;          ///< of the thinned clouds [m]; 0: about 4,000 points
  double uncommon = 0.5;      ///< share of the points that is compared, the least common ones
  Index similar = 100;        ///< target points to draw from
  int iterations = 25;
  double relative_change = 1e-3;
};

struct PfhIcpResult {
  Pose pose = Pose::Identity();  ///< source → target, of coordinates relative to their origins
  std::vector<IcpStep> steps;
  bool converged = false;
  Index pairs = 0;
  double fitness = 0.0;  ///< mean squared distance to the nearest target point [m²]
  double overlap = 0.0;  ///< share of the thinned source that has one near by
  NormalEquations::Directions directions;  ///< how firmly the pairs fix the pose, at the end
};

/// ICP over pairs of like features (Rusu 2010; thesis 3.2.2, equation 3.27): each of the source's
/// uncommon points is paired with a random one of the target's points whose histograms are most
/// like its own, of those within a distance that becomes shorter at each step; then point to plane.
/// Throws Error(Fault::stage) when too few pairs are left.
PfhIcpResult pfh_icp(const Cloud& source, const Cloud& target, const Pose& start,
                     const PfhIcpOptions& options, Context& context);

}  // namespace velum::registration
