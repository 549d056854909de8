// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "sail/frame.hpp"

namespace velum::sail {

/// The border of a sail from the tack up the luff, along the top and down the leech back to the
/// tack; corners are positions in it, tack at 0. A pointed sail has head and peak at one place or
/// next to each other.
struct Outline {
  Eigen::Matrix3Xd points;           ///< in sail axes
  std::vector<std::int32_t> places;  ///< of each point in the polygon that was given
  Eigen::VectorXd arc;               ///< length up to each point [m]
  double length = 0.0;               ///< all the way round [m]
  double spacing = 0.0;              ///< usual length of an edge [m]
  Index head = 0;                    ///< upper end of the luff
  Index peak = 0;                    ///< upper end of the leech
  Index clew = 0;
  /// Head and peak are so far apart that the edge between them has a direction of its own.
  bool has_top = false;
};

/// Corners are where two straight pieces of border fit best on either side, near the lowest
/// foremost point (tack), the lowest aftmost (clew) and the highest (head and peak). A throat
/// farther down the luff, or a peak farther down the leech, is taken where the border turns by more
/// than 35 degrees.
[[nodiscard]] Outline find_corners(const Eigen::Matrix3Xd& polygon, double spacing);

}  // namespace velum::sail
