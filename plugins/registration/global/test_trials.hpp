// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "test_pairs.hpp"

namespace velum::registration::test {

struct Trial {
  bool refused = false;
  bool right = false;
  std::string text;  ///< the miss, or why it was refused
};

/// By how much a right pose of all points is settled, from one of `registration.global`.
inline Transform settled(const Cloud& source, const Cloud& target,
                         const velum::test::Outcome& start) {
  // By planes the pose is settled on all points already.
  if (start.measure("by_planes") != 0.0) return start.get<Transform>();
  return velum::test::Stage("registration.icp")
      .set("metric", "point_to_plane")
      .set("max_distance", 0.7 * start.measure("resolution"))
      .set("keep", "0.9")
      .set("relative_change", "1e-5")
      .set("iterations", "60")
      .run(source, target, start.get<Transform>())
      .get<Transform>();
}

/// `global` from the pose `frame`, then ICP from what it found.
inline Trial trial(const Pair& pair, const Pose& frame) {
  Trial result;
  const Cloud source = pair.source.transformed(frame);
  try {
    const auto start = velum::test::Stage("registration.global").run(source, pair.target);
    const auto miss = geometry::difference(settled(source, pair.target, start).matrix,
                                           pair.truth * frame.inverse(), frame * pair.middle);
    result.right = miss.rotation < pair.rotation && miss.translation < pair.translation;
    result.text = std::to_string(miss.rotation / kDegree) + " deg, " +
                  std::to_string(1e3 * miss.translation) + " mm";
  } catch (const Error& error) {
    result.refused = true;
    result.text = error.what();
  }
  return result;
}

inline Pose random_frame(const Pair& pair, std::uint64_t seed) {
  Random random(seed);
  return velum::test::random_pose(random, pair.reach);
}

}  // namespace velum::registration::test
