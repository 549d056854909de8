// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "timing.hpp"

#include <algorithm>
#include <chrono>

namespace bench {
namespace {

double run_once(const Contender& contender, const Input& input) {
  const std::function<void()> work = contender.prepare(input);
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

std::vector<double> measure(const std::vector<Contender>& contenders, const Input& input) {
  // Taking turns lets the drift of the machine's speed fall on all alike.
  constexpr double kEnoughSeconds = 20.0;
  constexpr int kMostRounds = 5;
  std::vector<std::vector<double>> seconds(contenders.size());
  double spent = 0.0;
  for (int round = 0; round < kMostRounds && (round == 0 || spent < kEnoughSeconds); ++round) {
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      seconds[i].push_back(run_once(contenders[i], input));
      spent += seconds[i].back();
    }
  }
  std::vector<double> medians;
  for (const auto& s : seconds) medians.push_back(median(s));
  return medians;
}

}  // namespace bench
