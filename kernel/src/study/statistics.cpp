// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "velum/random.hpp"

namespace velum::study {
namespace {

double mean_of(const std::vector<double>& sample) {
  return std::accumulate(sample.begin(), sample.end(), 0.0) / static_cast<double>(sample.size());
}

double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

std::pair<double, double> bootstrap(const std::vector<double>& sample) {
  constexpr int kResamples = 2000;
  Random random(sample.size());
  const auto size = static_cast<std::int64_t>(sample.size());
  std::vector<double> means;
  for (int r = 0; r < kResamples; ++r) {
    double sum = 0.0;
    for (std::int64_t i = 0; i < size; ++i)
      sum += sample[static_cast<std::size_t>(random.below(size))];
    means.push_back(sum / static_cast<double>(size));
  }
  std::sort(means.begin(), means.end());
  return {quantile(means, 0.025), quantile(means, 0.975)};
}

/// Twice the midranks of |d|, ascending by |d|: whole numbers also where values are tied.
std::vector<std::size_t> double_ranks(const std::vector<double>& magnitudes) {
  std::vector<std::size_t> ranks(magnitudes.size());
  for (std::size_t begin = 0; begin < magnitudes.size();) {
    std::size_t end = begin + 1;
    while (end < magnitudes.size() && magnitudes[end] == magnitudes[begin]) ++end;
    for (std::size_t i = begin; i < end; ++i) ranks[i] = begin + 1 + end;
    begin = end;
  }
  return ranks;
}

}  // namespace

Summary summarise(std::vector<double> sample) {
  std::sort(sample.begin(), sample.end());
  Summary summary;
  summary.mean = mean_of(sample);
  double squares = 0.0;
  for (const double x : sample) squares += (x - summary.mean) * (x - summary.mean);
  if (sample.size() > 1) summary.sd = std::sqrt(squares / static_cast<double>(sample.size() - 1));
  summary.median = quantile(sample, 0.5);
  summary.q1 = quantile(sample, 0.25);
  summary.q3 = quantile(sample, 0.75);
  summary.ci95 = sample.size() > 1 ? bootstrap(sample) : std::pair(summary.mean, summary.mean);
  return summary;
}

double signed_rank_p(const std::vector<double>& differences) {
  std::vector<double> moved;
  for (const double d : differences)
    if (d != 0.0) moved.push_back(d);
  if (moved.empty()) return 1.0;
  std::ranges::sort(moved, {}, [](double d) { return std::abs(d); });
  std::vector<double> magnitudes;
  for (const double d : moved) magnitudes.push_back(std::abs(d));
  const std::vector<std::size_t> ranks = double_ranks(magnitudes);
  const std::size_t total = std::accumulate(ranks.begin(), ranks.end(), std::size_t{0});
  std::size_t positive = 0;
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (moved[i] > 0.0) positive += ranks[i];
  const std::size_t extreme = std::min(positive, total - positive);
  if (ranks.size() > kMostExact) {
    double variance = 0.0;  // of the doubled rank sum
    for (const std::size_t rank : ranks) variance += 0.25 * static_cast<double>(rank * rank);
    const double off = 0.5 * static_cast<double>(total) - static_cast<double>(extreme);
    return std::erfc(off / std::sqrt(2.0 * variance));
  }
  // Share of the 2^n ways to give signs that make each sum.
  std::vector<double> share(total + 1, 0.0);
  share[0] = 1.0;
  for (const std::size_t rank : ranks)
    for (std::size_t sum = total + 1; sum-- > 0;)
      share[sum] = 0.5 * (share[sum] + (sum >= rank ? share[sum - rank] : 0.0));
  const double tail =
      std::accumulate(share.begin(), share.begin() + static_cast<std::ptrdiff_t>(extreme) + 1, 0.0);
  return std::min(1.0, 2.0 * tail);
}

std::vector<double> holm(const std::vector<double>& p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p[i]; });
  std::vector<double> adjusted(p.size());
  double least = 0.0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    least = std::max(least, std::min(1.0, static_cast<double>(p.size() - k) * p[order[k]]));
    adjusted[order[k]] = least;
  }
  return adjusted;
}

std::vector<int> ranks(const std::vector<double>& values, bool lower_is_better) {
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> ranks;
  for (const double value : values) {
    const auto better = lower_is_better ? std::ranges::lower_bound(sorted, value) - sorted.begin()
                                        : sorted.end() - std::ranges::upper_bound(sorted, value);
    ranks.push_back(1 + static_cast<int>(better));
  }
  return ranks;
}

}  // namespace velum::study
