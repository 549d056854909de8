// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "formats/records.hpp"
#include "velum/context.hpp"

namespace velum::formats {

/// Where one coordinate comes from: a field and what to multiply it with.
struct Axis {
  const Field* field = nullptr;
  Index component = 0;
  double factor = 1.0;
};
using Axes = std::array<Axis, 3>;

/// Positions about an origin, and the records that they come from.
struct Positions {
  Points points;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<std::int32_t> kept;  ///< record of each point; empty when all were kept
  Index dropped = 0;               ///< records without three finite coordinates
  double rounding = 0.0;           ///< largest error of a coordinate by single precision [m]
};

/// Coordinates beyond this are no positions: their squares must fit a float [m].
inline constexpr double kLargestCoordinate = 1e15;

/// The origin of an axis whose coordinates lie in [low, high]: zero unless coordinates are large
/// both absolutely (over 1000 m) and beside the extent (over four times half of it); else the
/// middle, rounded to whole metres, or coarser where floats of that size are. Offsets of
/// coordinates that were floats are then floats too, so nothing is lost.
double choose_origin(double low, double high);

Positions read_positions(const Records& records, const Axes& axes, Context& context);

}  // namespace velum::formats
