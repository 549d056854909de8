// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "global/judge.hpp"

namespace velum::registration {

struct GlobalOptions {
  double cell = 0.0;  ///< of the thinned clouds [m]; 0: from the clouds, tried at five sizes
  double least_overlap = 0.15;  ///< of the smaller cloud that must lie on the other
  double least_gap = 0.15;      ///< share of its evidence by which the next pose must fall behind
  Index least_matches = 12;     ///< that agree with the pose
  double most_deviation =
      0.0;             ///< of a pose by planes along its weakest direction [m]; 0: no limit
  bool planes = true;  ///< ask the planes of both scans first, where scanners are known
};

struct GlobalCandidate {
  Pose pose = Pose::Identity();
  Index inliers = 0;  ///< matches that agree with it
  Agreement seen;
};

struct GlobalResult {
  Pose pose = Pose::Identity();  ///< relative to the clouds' origins
  std::vector<IcpStep> steps;
  Index candidates = 0;  ///< poses that were refined and compared
  Index matches = 0;     ///< pairs of features
  Index inliers = 0;     ///< those that agree with the pose
  Agreement seen;
  double gap = 0.0;  ///< share of its evidence by which the next pose falls behind
  double dominance =
      0.0;  ///< of what only one of the two explains, the best one's share less the other's
  double contradiction = 0.0;  ///< share of the points that the other scanner looked through
  double cell = 0.0;           ///< [m], as used
  bool by_planes = false;
  NormalEquations::Deviations deviations{};
  double weakest = 0.0;  ///< how well the least fixed direction is fixed, 0 to 1
  std::string refusal;   ///< why the pose is not to be trusted; empty when it is
  std::string hint;
};

/// Brings two clouds together from any start: matches of features, the motions that many of them
/// agree on, the one that the clouds themselves bear out. Throws Error(Fault::stage) with the
/// reason instead of returning a pose that is not borne out.
GlobalResult register_globally(const Cloud& source, const Cloud& target,
                               const GlobalOptions& options, Context& context);

/// One try with cells of one size; does not throw for want of evidence but says so.
GlobalResult try_globally(const Cloud& source, const Cloud& target, double cell,
                          const GlobalOptions& options, Context& context);

}  // namespace velum::registration
