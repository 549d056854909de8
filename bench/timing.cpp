// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>

namespace bench {
namespace {

double run_once(const Contender& contender, const Input& input) {
  const std::function<void()> work = contender.prepare(input);
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Not a number when the contender refuses the input, and why on the error stream.
double run_or_refuse(const Contender& contender, const Input& input) {
  try {
    return run_once(contender, input);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}, {}: {}\n", contender.operation, contender.name, error.what());
    return std::numeric_limits<double>::quiet_NaN();
  }
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

std::vector<double> measure(const Contenders& contenders, const Input& input) {
  // Taking turns lets the drift of the machine's speed fall on all alike.
  constexpr double kEnoughSeconds = 10.0;
  constexpr int kMostRounds = 5;
  std::vector<std::vector<double>> seconds(contenders.size());
  double spent = 0.0;
  for (int round = 0; round < kMostRounds && (round == 0 || spent < kEnoughSeconds); ++round) {
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      const bool refused = !seconds[i].empty() && std::isnan(seconds[i].back());
      if (refused) continue;
      seconds[i].push_back(run_or_refuse(contenders[i], input));
      if (!std::isnan(seconds[i].back())) spent += seconds[i].back();
    }
  }
  std::vector<double> medians;
  for (const auto& s : seconds) medians.push_back(median(s));
  return medians;
}

}  // namespace bench
