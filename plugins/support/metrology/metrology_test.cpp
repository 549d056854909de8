// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "metrology/distribution.hpp"
#include "metrology/trend.hpp"
#include "velum/random.hpp"

using namespace velum::metrology;

namespace {

std::vector<double> normal_sample(std::size_t count, std::uint64_t seed) {
  velum::Random random(seed);
  std::vector<double> sample(count);
  for (double& x : sample) x = 2.0 + 0.004 * random.gaussian();
  return sample;
}

}  // namespace

TEST_CASE("moments of a sample counted by hand") {
  const Moments found = moments(std::vector<double>{2, 4, 4, 4, 5, 5, 7, 9});
  CHECK(found.count == 8);
  CHECK(found.mean == 5.0);
  CHECK(found.deviation == Approx(std::sqrt(32.0 / 7.0)));
  CHECK(found.skewness == Approx(42.0 / 8.0 / 8.0));          // sum of cubes 42, variance 4
  CHECK(found.kurtosis == Approx(356.0 / 8.0 / 16.0 - 3.0));  // sum of fourth powers 356
  CHECK((found.least == 2.0 && found.greatest == 9.0));
}

TEST_CASE("a far offset costs the moments nothing") {
  std::vector<double> sample{0.001, 0.002, 0.003, 0.006};
  const Moments near = moments(sample);
  for (double& x : sample) x += 1e5;
  const Moments far = moments(sample);
  CHECK(far.deviation == Approx(near.deviation).epsilon(1e-6));
  CHECK(far.skewness == Approx(near.skewness).epsilon(1e-5));
}

TEST_CASE("equal readings have no spread, one reading is its own mean") {
  CHECK(moments(std::vector<double>(5, 3.0)).deviation == 0.0);
  CHECK(moments(std::vector<double>{7.0}).mean == 7.0);
  CHECK(moments({}).count == 0);
}

TEST_CASE("the scores of skewness and kurtosis are those of other programs") {
  // scipy.stats.skewtest and kurtosistest give these in their documentation.
  CHECK(normality(moments(std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8000})).skewness ==
        Approx(3.571773510360407));
  CHECK(normality(moments(std::vector<double>{2, 8, 0, 4, 1, 9, 9, 0})).skewness ==
        Approx(0.44626385374196975));
  std::vector<double> twenty(20);
  for (std::size_t i = 0; i < 20; ++i) twenty[i] = static_cast<double>(i);
  CHECK(normality(moments(twenty)).kurtosis == Approx(-1.7058104152122062));
}

TEST_CASE("normal samples pass the test as often as they should, others do not") {
  int refused = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed)
    refused += normality(moments(normal_sample(1000, seed))).p < 0.05 ? 1 : 0;
  CHECK(refused > 8);
  CHECK(refused < 34);
  velum::Random random(5);
  std::vector<double> flat(1000);
  for (double& x : flat) x = random.uniform();
  CHECK(normality(moments(flat)).p < 1e-6);
  auto tailed = normal_sample(1000, 9);
  for (std::size_t i = 0; i < 10; ++i) tailed[i] += 0.03;
  CHECK(normality(moments(tailed)).p < 1e-6);
}

TEST_CASE("a slope and its significance, by hand") {
  // Slope 0.6, residuals of sum 2.4: standard error sqrt(2.4 / 3 / 10), t = 2.1213, df = 3.
  const Trend found = trend(std::vector<double>{1, 2, 3, 4, 5}, std::vector<double>{2, 4, 5, 4, 5});
  CHECK(found.slope == Approx(0.6));
  CHECK(found.error == Approx(std::sqrt(0.08)));
  CHECK(found.p == Approx(0.1240).margin(1e-4));
}

TEST_CASE("noise has no trend, and a real one shows") {
  const auto values = normal_sample(5000, 4);
  std::vector<double> times(values.size());
  std::vector<double> drifting(values);
  for (std::size_t i = 0; i < times.size(); ++i) {
    times[i] = static_cast<double>(i);
    drifting[i] += 2e-7 * times[i];
  }
  CHECK(trend(times, values).p > 0.01);
  CHECK(trend(times, drifting).p < 1e-4);
  CHECK(trend(times, drifting).slope == Approx(2e-7).epsilon(0.5));
}

TEST_CASE("too little to have a trend") {
  CHECK(trend(std::vector<double>{1, 2}, std::vector<double>{1, 5}).p == 1.0);
  CHECK(trend(std::vector<double>{2, 2, 2}, std::vector<double>{1, 5, 6}).slope == 0.0);
  CHECK(trend(std::vector<double>{1, 2, 3}, std::vector<double>{4, 4, 4}).p == 1.0);
  CHECK(trend(std::vector<double>{1, 2, 3}, std::vector<double>{1, 2, 3}).p ==
        Approx(0.0).margin(1e-6));
}

TEST_CASE("the normal distribution") {
  CHECK(below(0.0, 0.0, 1.0) == 0.5);
  CHECK(below(1.96, 0.0, 1.0) == Approx(0.975).margin(1e-4));
  CHECK(below(2.004, 2.0, 0.004) == Approx(0.8413).margin(1e-4));
}
