// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

/// What is said of a measure over repeats. All of it takes finite numbers only.
namespace velum::study {

/// Of a sample of at least one.
struct Summary {
  double mean = 0.0;
  double sd = 0.0;  ///< with n - 1; 0 for one
  double median = 0.0;
  double q1 = 0.0;  ///< quartiles between order statistics, as R's type 7
  double q3 = 0.0;
  /// 95 % interval of the mean: percentile bootstrap (Efron and Tibshirani, 1993, ch. 13) of 2,000
  /// resamples, the same for the same sample.
  std::pair<double, double> ci95;
};
[[nodiscard]] Summary summarise(std::vector<double> sample);

/// Two-sided p value of Wilcoxon's signed-rank test that the paired differences lie about 0, from
/// the exact distribution of the rank sum given the (mid)ranks, also with ties; differences of 0
/// are left out (Wilcoxon, Biometrics Bulletin 1, 1945). 1 when none is left. Above kMostExact
/// differences by the normal approximation, which is right to a few per cent of p by then.
[[nodiscard]] double signed_rank_p(const std::vector<double>& differences);

inline constexpr std::size_t kMostExact = 200;

/// p values made right for being several: Holm's step-down (Scandinavian Journal of Statistics 6,
/// 1979), in the order given.
[[nodiscard]] std::vector<double> holm(const std::vector<double>& p);

/// 1 for the best; equal values share a rank and the next one counts them ("1, 2, 2, 4").
[[nodiscard]] std::vector<int> ranks(const std::vector<double>& values, bool lower_is_better);

/// Fewer repeats than this carry no claim: the exact test cannot reach 5 % with five.
inline constexpr std::size_t kFewestForAClaim = 6;

}  // namespace velum::study
