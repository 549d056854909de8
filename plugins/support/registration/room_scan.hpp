// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geometry/find_planes.hpp"
#include "registration/range_image.hpp"
#include "velum/cloud.hpp"
#include "velum/context.hpp"

namespace velum::registration {

/// A cloud prepared to be asked about poses: its planes, what is on none of them, and what its
/// scanners saw from where. Positions relative to the cloud's origin.
struct RoomScan {
  struct Eye {
    Eigen::Vector3d position;
    RangeImage image;
  };
  Cloud cloud;
  geometry::ScenePlanes scene;
  std::vector<std::int32_t> rest;  ///< points on no plane
  Points rest_thin;                ///< a few thousand of them, evenly spread
  Points wall_thin;                ///< and of the others
  double fine = 0.0;               ///< spacing of rest_thin [m]
  std::vector<Eye> eyes;           ///< one a sensor; the origin of the axes where there is none
};

RoomScan prepare(const Cloud& cloud, const geometry::PlaneSearch& search, Context& context);

/// What two scans say about a pose (source → target, relative to their origins): shares of all
/// their points, both ways.
struct Evidence {
  double agrees = 0.0;         ///< of the rest that the other scanner saw something at
  double blocked = 0.0;        ///< of the rest that the other scanner looked through
  double walls_blocked = 0.0;  ///< of the planes' points that the other scanner looked through
  [[nodiscard]] double total() const { return agrees - 2.0 * blocked - 2.0 * walls_blocked; }
};

/// `margin` [m] is how wrong the pose may be; `stride` > 1 asks every stride-th point only.
Evidence evidence(const RoomScan& source, const RoomScan& target, const Pose& pose, double margin,
                  Index stride = 1);

}  // namespace velum::registration
