// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>
#include <velum/context.hpp>

namespace velum::upsample {

/// A place for a new point, and the given point whose columns it takes.
struct Candidate {
  Eigen::Vector3f at;
  std::int32_t owner;
};

/// Least distance between points, of the wanted spacing: with places this far apart wherever there
/// is room, no place is farther from a point than 0.7 of the spacing and a step of the lattice.
inline constexpr double kApart = 0.7;

/// In their order, those that are at least `apart` [m] from all chosen before.
std::vector<Candidate> spread(const std::vector<Candidate>& places, double apart, Context& context);

}  // namespace velum::upsample
