// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

namespace velum::metrology {

/// What a sample of one quantity looks like.
struct Moments {
  std::size_t count = 0;
  double mean = 0.0;
  double deviation = 0.0;  ///< of the population, as the sample shows it (n - 1); 0 for one reading
  double skewness = 0.0;   ///< third standardised moment; 0 where all readings are equal
  double kurtosis = 0.0;   ///< fourth standardised moment less 3; 0 where all readings are equal
  double least = 0.0;
  double greatest = 0.0;
};
[[nodiscard]] Moments moments(std::span<const double> sample);

/// Fewest readings for which normality() says something.
inline constexpr std::size_t kFewestForNormality = 20;

/// A test of normality: K² of D'Agostino and Pearson (The American Statistician 44, 1990) and its
/// parts, which are standard normal where the sample is.
struct Normality {
  double skewness = 0.0;
  double kurtosis = 0.0;
  double statistic = 0.0;
  double p = 1.0;  ///< chance of a statistic as large from a normal population
};
/// For at least kFewestForNormality readings that are not all equal.
[[nodiscard]] Normality normality(const Moments& moments);

/// Chance that a normal quantity lies below `x`.
[[nodiscard]] double below(double x, double mean, double deviation);

}  // namespace velum::metrology
