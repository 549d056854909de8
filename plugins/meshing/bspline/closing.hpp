// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "sail/border.hpp"
#include "trimming.hpp"

namespace velum::meshing {

/// The border's curves, in the unrolled plane (x, 0, y), as one closed loop, counter-clockwise:
/// foot, leech, top, luff downward. Where it crosses itself, as luff and leech do above a pointed
/// head, the shorter part is cut off.
[[nodiscard]] TrimmingCurve closed(const sail::Border& border);

}  // namespace velum::meshing
