// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "global/matches.hpp"

namespace velum::registration {

struct RobustFit {
  Pose pose = Pose::Identity();
  std::vector<std::int32_t> inliers;  ///< matches within the bound
  bool fixed = false;                 ///< the inliers span more than a line
};

/// The motion that most of `chosen` matches agree on within `bound` [m]: truncated least squares by
/// graduated non-convexity (Yang, Antonante, Tzoumas, Carlone 2020). The loss starts convex and
/// becomes the truncated one step by step, each step a weighted fit in closed form.
RobustFit robust_fit(const std::vector<Match>& matches, std::span<const std::int32_t> chosen,
                     double bound);

}  // namespace velum::registration
