// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bspline/evaluate.hpp"

namespace velum::cad {

/// A part of a trimming loop between two corners, 2×n in (u, v), ends included.
struct Piece {
  Eigen::Matrix2Xd uv;
  bool pole = false;  ///< two places of (u, v) that are one on the surface
};

/// The loop without points that repeat the one before, counter-clockwise or clockwise as asked.
/// Throws Error (Fault::stage) when fewer than three are left or one is outside the surface's
/// range.
Eigen::Matrix2Xd clean_loop(const bspline::Patch& patch, const Eigen::Matrix2Xd& loop,
                            bool counter_clockwise);

/// Cuts a closed loop where its image on the surface turns by more than 30 degrees at a point, and
/// around poles; a loop without corners is cut into halves. The end of each piece begins the next.
std::vector<Piece> pieces_of(const bspline::Patch& patch, const Eigen::Matrix2Xd& loop);

}  // namespace velum::cad
