// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "global/sampled.hpp"

namespace velum::registration {

/// A point of the source and one of the target whose surroundings look alike. Normals are those of
/// the source and, with the sign under which the features agree, of the target.
struct Match {
  Eigen::Vector3d from;
  Eigen::Vector3d to;
  Eigen::Vector3d from_normal;
  Eigen::Vector3d to_normal;
};

/// Pairs of keys that are among each other's `nearest` most alike, at most `most`, the most alike
/// first. Most of them are wrong as a rule.
std::vector<Match> match_features(const Sampled& source, const Sampled& target, Index nearest,
                                  Index most, Context& context);

}  // namespace velum::registration
