// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "metrology/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace velum::metrology {
namespace {

// Standard normal where the skewness g of n readings is a normal population's (D'Agostino 1970).
double skewness_score(double g, double n) {
  const double y = g * std::sqrt((n + 1.0) * (n + 3.0) / (6.0 * (n - 2.0)));
  const double b = 3.0 * (n * n + 27.0 * n - 70.0) * (n + 1.0) * (n + 3.0) /
                   ((n - 2.0) * (n + 5.0) * (n + 7.0) * (n + 9.0));
  const double w = std::sqrt(2.0 * (b - 1.0)) - 1.0;
  return std::asinh(y / std::sqrt(2.0 / (w - 1.0))) / std::sqrt(0.5 * std::log(w));
}

// The same for the kurtosis k, less 3 (Anscombe and Glynn 1983).
double kurtosis_score(double k, double n) {
  const double expected = -6.0 / (n + 1.0);
  const double variance =
      24.0 * n * (n - 2.0) * (n - 3.0) / ((n + 1.0) * (n + 1.0) * (n + 3.0) * (n + 5.0));
  const double x = (k - expected) / std::sqrt(variance);
  const double skew = 6.0 * (n * n - 5.0 * n + 2.0) / ((n + 7.0) * (n + 9.0)) *
                      std::sqrt(6.0 * (n + 3.0) * (n + 5.0) / (n * (n - 2.0) * (n - 3.0)));
  const double a = 6.0 + 8.0 / skew * (2.0 / skew + std::sqrt(1.0 + 4.0 / (skew * skew)));
  const double root = std::cbrt((1.0 - 2.0 / a) / (1.0 + x * std::sqrt(2.0 / (a - 4.0))));
  return (1.0 - 2.0 / (9.0 * a) - root) / std::sqrt(2.0 / (9.0 * a));
}

}  // namespace

Moments moments(std::span<const double> sample) {
  Moments found;
  found.count = sample.size();
  if (sample.empty()) return found;
  const auto n = static_cast<double>(sample.size());
  double sum = 0.0;
  for (const double x : sample) sum += x - sample.front();
  found.mean = sample.front() + sum / n;
  const auto [least, greatest] = std::minmax_element(sample.begin(), sample.end());
  found.least = *least;
  found.greatest = *greatest;
  double second = 0.0;
  double third = 0.0;
  double fourth = 0.0;
  for (const double x : sample) {
    const double off = x - found.mean;
    second += off * off;
    third += off * off * off;
    fourth += off * off * off * off;
  }
  if (found.least == found.greatest) return found;
  found.deviation = std::sqrt(second / (n - 1.0));
  const double variance = second / n;
  found.skewness = third / n / (variance * std::sqrt(variance));
  found.kurtosis = fourth / n / (variance * variance) - 3.0;
  return found;
}

Normality normality(const Moments& moments) {
  const auto n = static_cast<double>(moments.count);
  Normality test;
  test.skewness = skewness_score(moments.skewness, n);
  test.kurtosis = kurtosis_score(moments.kurtosis, n);
  test.statistic = test.skewness * test.skewness + test.kurtosis * test.kurtosis;
  test.p = std::exp(-0.5 * test.statistic);
  return test;
}

double below(double x, double mean, double deviation) {
  return 0.5 * std::erfc((mean - x) / (deviation * std::numbers::sqrt2));
}

}  // namespace velum::metrology
