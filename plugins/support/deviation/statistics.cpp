// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "deviation/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace velum::deviation {

Statistics statistics(const Eigen::VectorXf& values) {
  Statistics found;
  const Index n = values.size();
  if (n == 0) return found;
  std::vector<float> sorted(values.data(), values.data() + n);
  std::sort(sorted.begin(), sorted.end());
  const auto quantile = [&](double share) {
    const double place = std::ceil(share * static_cast<double>(n)) - 1.0;
    return static_cast<double>(sorted[static_cast<std::size_t>(std::max(place, 0.0))]);
  };
  const Eigen::VectorXd exact = values.cast<double>();
  found.mean = exact.mean();
  found.rms = std::sqrt(exact.squaredNorm() / static_cast<double>(n));
  found.median = quantile(0.5);
  found.p95 = quantile(0.95);
  found.max = static_cast<double>(sorted.back());
  return found;
}

void report(const Statistics& found, const std::string& prefix, const std::string& unit,
            Context& context) {
  context.measure(prefix + "mean", found.mean, unit, Better::lower);
  context.measure(prefix + "rms", found.rms, unit, Better::lower);
  context.measure(prefix + "median", found.median, unit, Better::lower);
  context.measure(prefix + "p95", found.p95, unit, Better::lower);
  context.measure(prefix + "max", found.max, unit, Better::lower);
}

Table histogram_table() {
  return Table(
      {{"quantity", ""}, {"unit", ""}, {"from", ""}, {"to", ""}, {"points", ""}, {"share", "%"}});
}

void add_histogram(Table& table, const std::string& quantity, const std::string& unit,
                   const Eigen::VectorXf& values, int bins, double limit) {
  const double greatest = values.size() > 0 ? static_cast<double>(values.maxCoeff()) : 0.0;
  const double end = limit > 0.0 ? limit : greatest;
  const double width = end > 0.0 ? end / bins : 1.0;
  std::vector<std::int64_t> counts(static_cast<std::size_t>(bins), 0);
  for (const float value : values) {
    const double place = std::clamp(static_cast<double>(value) / width, 0.0, bins - 1.0);
    ++counts[static_cast<std::size_t>(place)];
  }
  for (int i = 0; i < bins; ++i) {
    const std::int64_t count = counts[static_cast<std::size_t>(i)];
    const bool last = i + 1 == bins;
    table.add({quantity, unit, i * width, last ? std::max(end, greatest) : (i + 1) * width, count,
               100.0 * static_cast<double>(count) /
                   static_cast<double>(std::max<Index>(values.size(), 1))});
  }
}

}  // namespace velum::deviation
