// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "shapes/shape.hpp"

namespace velum::shapes {

/// A shape through a sample, and how many of the first points of a random order agree with it.
struct Candidate {
  Shape shape;
  Index tested = 0;  ///< points of the shuffled sequence
  Index agreed = 0;  ///< of them
  int level = 0;
};

/// A count over all points, from that over a random part of them.
struct Estimate {
  double mean;
  double low;
  double high;
};
/// Mean and deviation of the hypergeometric distribution behind it (Schnabel et al. 2007, eq. 12).
inline Estimate estimate(const Candidate& c, Index all) {
  const auto n = static_cast<double>(all);
  const auto m = static_cast<double>(c.tested);
  const double mean = n * static_cast<double>(c.agreed + 1) / (m + 2.0);
  if (c.tested >= all) {
    const auto exact = static_cast<double>(c.agreed);
    return {exact, exact, exact};
  }
  const double share = mean / n;
  const double deviation = n * std::sqrt(share * (1.0 - share) / m * (1.0 - m / n));
  return {mean, mean - 2.0 * deviation, mean + 2.0 * deviation};
}

}  // namespace velum::shapes
