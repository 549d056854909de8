// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace velum::registration {
namespace {

/// Of the mean curvature: what an even point counts.
constexpr double kFloor = 0.1;

/// Systematic sampling: one draw, then steps of equal weight, so that no stretch of points is left
/// out by chance. A point heavier than a step is taken once.
std::vector<std::int32_t> systematic(const std::vector<double>& weights, double wanted,
                                     Random random) {
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double step = total / wanted;
  std::vector<std::int32_t> chosen;
  double next = step * random.uniform();
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i];
    if (sum <= next) continue;
    chosen.push_back(static_cast<std::int32_t>(i));
    next += step * std::ceil((sum - next) / step);
  }
  return chosen;
}

double wanted_of(const Cloud& cloud, double share, Index least) {
  const auto n = static_cast<double>(cloud.size());
  return std::clamp(share * n, std::min(n, static_cast<double>(least)), n);
}

}  // namespace

std::vector<std::int32_t> random_sample(const Cloud& cloud, double share, Index least,
                                        Random random) {
  std::vector<std::int32_t> all(static_cast<std::size_t>(cloud.size()));
  std::iota(all.begin(), all.end(), 0);
  // The first places of a shuffle (Fisher and Yates).
  const auto wanted = static_cast<std::size_t>(std::llround(wanted_of(cloud, share, least)));
  for (std::size_t i = 0; i < wanted; ++i)
    std::swap(
        all[i],
        all[i + static_cast<std::size_t>(random.below(static_cast<std::int64_t>(all.size() - i)))]);
  all.resize(wanted);
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<std::int32_t> curvature_sample(const Cloud& cloud, double share, Index least,
                                           Random random) {
  const auto curvature = cloud.curvature();
  std::vector<double> weights(static_cast<std::size_t>(cloud.size()));
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const auto value = static_cast<double>(curvature[static_cast<Index>(i)]);
    weights[i] = std::isfinite(value) ? std::max(0.0, value) : 0.0;
    sum += weights[i];
  }
  const double floor = sum > 0.0 ? kFloor * sum / static_cast<double>(cloud.size()) : 1.0;
  for (double& weight : weights) weight = std::max(weight, floor);
  return systematic(weights, wanted_of(cloud, share, least), random);
}

}  // namespace velum::registration
