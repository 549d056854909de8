// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "metrology/trend.hpp"

#include <boost/math/special_functions/beta.hpp>
#include <cmath>

#include "metrology/distribution.hpp"

namespace velum::metrology {
namespace {

// Chance of |t| or more from Student's distribution.
double both_tails(double t, double freedom) {
  if (!std::isfinite(t)) return 0.0;
  return boost::math::ibeta(0.5 * freedom, 0.5, freedom / (freedom + t * t));
}

}  // namespace

Trend trend(std::span<const double> times, std::span<const double> values) {
  Trend found;
  if (times.size() < 3) return found;
  const double mean_time = moments(times).mean;
  const double mean_value = moments(values).mean;
  double tt = 0.0;
  double tv = 0.0;
  double vv = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double t = times[i] - mean_time;
    const double v = values[i] - mean_value;
    tt += t * t;
    tv += t * v;
    vv += v * v;
  }
  if (tt <= 0.0) return found;
  found.slope = tv / tt;
  if (vv <= 0.0) return found;
  const auto freedom = static_cast<double>(times.size()) - 2.0;
  found.error = std::sqrt(std::fmax(0.0, vv - found.slope * tv) / freedom / tt);
  found.p = both_tails(found.slope / found.error, freedom);
  return found;
}

}  // namespace velum::metrology
