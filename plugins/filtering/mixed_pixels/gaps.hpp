// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>
#include <velum/cloud.hpp>
#include <velum/context.hpp>

namespace velum::mixed {

/// What the scanner's beam is like. Defaults are those of the SICK LMS 511 with high resolution.
struct Beam {
  double noise = 0.004;    ///< standard deviation of a range [m] (thesis 2.4.3.2)
  double window = 0.013;   ///< diameter of the spot at the scanner [m]
  double growth = 0.0046;  ///< growth of the diameter per metre of range
  [[nodiscard]] double spot(double range) const { return window + growth * range; }
};

/// Which points hang in the gap between two surfaces along their ray (1, else 0), seen from where
/// their sensor stands (thesis 2.4.3.8).
///
/// The neighbours of a point are those in nearly the same direction. Over the directions a plane is
/// linear in the inverse of depth. A point is on a surface when the neighbours of a whole quarter
/// around it, wider than the spot, lie on one plane to within their noise and the plane predicts
/// the point; or, in a second pass over the others, when sure neighbours or a strip of neighbours
/// do. What is on no surface and has something behind it is in a gap: against the sky there are no
/// mixed pixels.
std::vector<std::uint8_t> in_gaps(const Cloud& cloud, const Beam& beam, Context& context);

}  // namespace velum::mixed
