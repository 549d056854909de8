// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "sail/shape.hpp"

namespace velum::sail {

/// A section before it is known which side is leeward: the chord's angle counts from aft towards
/// the y axis, and `bulge` is the camber with its sign there.
struct RawSection {
  Section values;
  double bulge = 0.0;
};

/// The section at height z of sail axes, fitted to all vertices within `band` of it. Each vertex
/// has a place t along, and an offset from, the line between luff and leech at its own height; the
/// offsets are smoothed by B-splines in t whose coefficients change with height as parabolas. So
/// the section is the mean of what lies about it and not a cut through noise, and stays free of
/// bias where chord, twist and camber change with height.
[[nodiscard]] RawSection fit_section(const Sheet& sheet, const Border& border, double z,
                                     double band, double tangent);

}  // namespace velum::sail
