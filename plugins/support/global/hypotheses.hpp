// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "global/matches.hpp"

namespace velum::registration {

/// A motion that a group of matches agrees on.
struct Hypothesis {
  Pose pose = Pose::Identity();
  Index inliers = 0;  ///< of all matches
};

/// The motions that cliques of the consistency graph stand for, each settled by robust_fit; those
/// with most inliers first, at most `most`, no two the same. `bound` [m] is how far a right match
/// may be off; `place` is where motions are compared.
std::vector<Hypothesis> hypotheses_of(const std::vector<Match>& matches, double bound,
                                      const Eigen::Vector3d& place, std::size_t most,
                                      Context& context);

/// Matches that the motion brings within `bound` [m] with normals that agree.
Index inliers_of(const std::vector<Match>& matches, const Pose& pose, double bound);

/// Are both the same but for what refinement will settle?
bool same_motion(const Pose& a, const Pose& b, const Eigen::Vector3d& place, double bound);

}  // namespace velum::registration
