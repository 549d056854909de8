// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/statistics.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "velum/random.hpp"

using namespace velum::study;  // NOLINT: a test

namespace {

/// The test by its definition: all 2^n ways to give the differences signs.
double by_enumeration(const std::vector<double>& differences) {
  const auto statistic = [&](unsigned signs) {
    double sum = 0.0;
    for (std::size_t i = 0; i < differences.size(); ++i) {
      double rank = 0.5;
      for (const double other : differences) {
        if (std::abs(other) < std::abs(differences[i])) rank += 1.0;
        if (std::abs(other) == std::abs(differences[i])) rank += 0.5;
      }
      if ((signs >> i & 1U) != 0) sum += rank;
    }
    return sum;
  };
  const auto all = 1U << differences.size();
  unsigned own = 0;
  for (std::size_t i = 0; i < differences.size(); ++i)
    if (differences[i] > 0.0) own |= 1U << i;
  const double middle = statistic(all - 1) / 2.0;
  int as_far = 0;
  for (unsigned signs = 0; signs < all; ++signs)
    if (std::abs(statistic(signs) - middle) >= std::abs(statistic(own) - middle)) ++as_far;
  return static_cast<double>(as_far) / all;
}

}  // namespace

TEST_CASE("mean, deviation and quartiles as R gives them") {
  const Summary s = summarise({4, 1, 3, 2});
  CHECK(s.mean == 2.5);
  CHECK(s.sd == Approx(1.290994448736));
  CHECK(s.median == 2.5);
  CHECK(s.q1 == 1.75);
  CHECK(s.q3 == 3.25);
}

TEST_CASE("one value, and equal values, have no spread") {
  for (const std::vector<double>& sample : {std::vector{7.0}, {7.0, 7.0, 7.0}}) {
    const Summary s = summarise(sample);
    CHECK(s.mean == 7.0);
    CHECK(s.sd == 0.0);
    CHECK(s.ci95 == std::pair(7.0, 7.0));
  }
}

TEST_CASE("the bootstrap interval is the same again, and covers the mean as often as it says") {
  velum::Random random(3);
  int covered = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<double> sample;
    for (int i = 0; i < 30; ++i) sample.push_back(5.0 + random.gaussian());
    const auto [low, high] = summarise(sample).ci95;
    CHECK(summarise(sample).ci95 == std::pair(low, high));
    if (low <= 5.0 && 5.0 <= high) ++covered;
  }
  CHECK(covered >= 270);  // 95 % of 300 is 285; percentile intervals of 30 are a little short
  CHECK(covered <= 296);
}

TEST_CASE("the signed-rank test agrees with published values") {
  // Hollander and Wolfe, Nonparametric Statistical Methods (1973), table 3.1: V = 40, p = 0.0391.
  const std::vector<double> before = {1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30};
  const std::vector<double> after = {0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
  std::vector<double> differences;
  for (std::size_t i = 0; i < before.size(); ++i) differences.push_back(before[i] - after[i]);
  CHECK(signed_rank_p(differences) == Approx(0.0390625));
}

TEST_CASE("six repeats can reach 5 %, five cannot") {
  CHECK(signed_rank_p({1, 2, 3, 4, 5, 6}) == Approx(2.0 / 64));
  CHECK(signed_rank_p({-1, -2, -3, -4, -5, -6}) == Approx(2.0 / 64));
  CHECK(signed_rank_p({1, 2, 3, 4, 5}) == Approx(2.0 / 32));
}

TEST_CASE("ties are exact, zeros are left out") {
  velum::Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> differences;
    while (differences.size() < 9) {
      const auto d = static_cast<double>(random.below(9) - 4);  // many ties
      if (d != 0.0) differences.push_back(d);
    }
    CHECK(signed_rank_p(differences) == Approx(by_enumeration(differences)));
    std::vector<double> with_zeros = differences;
    with_zeros.insert(with_zeros.end(), {0.0, 0.0});
    CHECK(signed_rank_p(with_zeros) == signed_rank_p(differences));
  }
  CHECK(signed_rank_p({0.0, 0.0}) == 1.0);
  CHECK(signed_rank_p({}) == 1.0);
}

TEST_CASE("of many differences the normal approximation, which is close to the exact one") {
  velum::Random random(7);
  std::vector<double> differences;
  while (differences.size() < kMostExact) differences.push_back(random.gaussian() + 0.15);
  const double exact = signed_rank_p(differences);
  differences.push_back(0.01);
  CHECK(exact < 0.2);
  CHECK(signed_rank_p(differences) == Approx(exact).epsilon(0.1));
}

TEST_CASE("Holm's correction steps down and never turns back") {
  const auto adjusted = holm({0.02, 0.01, 0.04, 0.03});
  CHECK(adjusted[1] == Approx(0.04));
  CHECK(adjusted[0] == Approx(0.06));
  CHECK(adjusted[3] == Approx(0.06));
  CHECK(adjusted[2] == Approx(0.06));
  CHECK(holm({0.9, 0.8}) == std::vector<double>{1.0, 1.0});
  CHECK(holm({}).empty());
}

TEST_CASE("equal values share a rank") {
  CHECK(ranks({3, 1, 2, 2}, true) == std::vector<int>{4, 1, 2, 2});
  CHECK(ranks({3, 1, 2, 2}, false) == std::vector<int>{1, 4, 2, 2});
}
