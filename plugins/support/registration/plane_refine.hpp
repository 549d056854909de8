// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "registration/icp.hpp"
#include "registration/plane_matching.hpp"
#include "registration/room_scan.hpp"

namespace velum::registration {

/// What is left of two scans without their planes, ready to be paired.
struct RestPair {
  Points source;
  Cloud target;  ///< with normals
};
/// At most `most` points of the source.
RestPair make_rest(const RoomScan& source, const RoomScan& target, Index most, Context& context);

struct Refined {
  Pose pose = Pose::Identity();
  NormalEquations equations{Eigen::Vector3d::Zero()};  ///< at the end
  double radius = 1.0;                                 ///< of the scene, for turns [m]
  double sigma = 0.0;      ///< RMS gap of the pairs and planes, as weighted [m]
  double plane_gap = 0.0;  ///< RMS distance between matched planes at their centres [m]
  Index pairs = 0;         ///< of the rest
  std::vector<IcpStep> steps;
};

/// Point to plane on everything at once: each matched plane by all its points against the other's
/// fitted plane, and the rest by its nearest target points within a distance that shrinks from
/// `first` to `last` [m]. Pairs that disagree with the others are weighted down.
Refined refine(const RoomScan& source, const RoomScan& target, const RestPair& rest,
               const Assignment& assignment, double first, double last, Context& context);

}  // namespace velum::registration
