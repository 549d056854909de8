// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "global/matches.hpp"

namespace velum::registration::test {

inline Eigen::Vector3d anywhere(Random& random, double reach) {
  const double x = random.uniform(-reach, reach);
  const double y = random.uniform(-reach, reach);
  return {x, y, random.uniform(-reach, reach)};
}

inline Eigen::Vector3d any_way(Random& random) {
  const double x = random.gaussian();
  const double y = random.gaussian();
  return Eigen::Vector3d(x, y, random.gaussian()).normalized();
}

inline Pose some_motion() {
  Pose pose = Pose::Identity();
  pose.linear() =
      Eigen::AngleAxisd(2.1, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  pose.translation() << 3.0, -1.0, 2.0;
  return pose;
}

/// `right` matches over 1 m about `centre` that `motion` brings about but for `noise` [m], then
/// `wrong` ones by chance.
inline std::vector<Match> planted(int right, int wrong, const Pose& motion, double noise = 0.0,
                                  const Eigen::Vector3d& centre = Eigen::Vector3d::Zero()) {
  Random random(9);
  std::vector<Match> matches;
  for (int i = 0; i < right + wrong; ++i) {
    const Eigen::Vector3d from = centre + anywhere(random, 0.5);
    const Eigen::Vector3d normal = any_way(random);
    const Eigen::Vector3d off = noise * any_way(random);
    const Eigen::Vector3d stray = anywhere(random, 0.5);
    const Eigen::Vector3d stray_normal = any_way(random);
    if (i < right)
      matches.push_back({from, motion * from + off, normal, motion.linear() * normal});
    else
      matches.push_back({from, motion * centre + stray, normal, stray_normal});
  }
  return matches;
}

}  // namespace velum::registration::test
