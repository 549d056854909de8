// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <limits>
#include <numeric>

#include "geometry/motion.hpp"
#include "geometry/rigid_fit.hpp"
#include "global/robust_fit.hpp"
#include "global/test_matches.hpp"

using namespace velum::registration;
using namespace velum::registration::test;
using velum::Index;
using velum::Pose;

namespace {

constexpr double kBound = 0.02;

RobustFit fit(const std::vector<Match>& matches, double bound = kBound) {
  std::vector<std::int32_t> all(matches.size());
  std::iota(all.begin(), all.end(), 0);
  return robust_fit(matches, all, bound);
}

}  // namespace

TEST_CASE("half of the matches may be wrong, and the motion of the others is exact") {
  const auto matches = planted(40, 40, some_motion());
  const RobustFit found = fit(matches);
  CHECK(found.fixed);
  REQUIRE(found.inliers.size() >= 40);
  for (std::int32_t i = 0; i < 40; ++i) CHECK(found.inliers[static_cast<std::size_t>(i)] == i);
  const auto miss = velum::geometry::difference(found.pose, some_motion());
  CHECK(miss.rotation < 1e-9);
  CHECK(miss.translation < 1e-9);
}

TEST_CASE("with noise it is the least-squares motion of those within the bound") {
  const auto matches = planted(60, 20, some_motion(), 0.01);
  const RobustFit found = fit(matches);
  const auto count = static_cast<Index>(found.inliers.size());
  Eigen::Matrix3Xd from(3, count);
  Eigen::Matrix3Xd to(3, count);
  for (Index i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(found.inliers[static_cast<std::size_t>(i)]);
    from.col(i) = matches[at].from;
    to.col(i) = matches[at].to;
  }
  const std::vector<double> weights(found.inliers.size(), 1.0);
  const Pose plain = velum::geometry::rigid_fit(from, to, weights).pose;
  const auto miss = velum::geometry::difference(found.pose, plain);
  CHECK(miss.rotation < 1e-9);
  CHECK(miss.translation < 1e-9);
  CHECK(velum::geometry::difference(found.pose, some_motion()).translation < 0.01);
}

TEST_CASE("coordinates of ten thousand kilometres do not hurt") {
  const Eigen::Vector3d centre(1e7, -4e6, 3e6);
  const auto matches = planted(30, 10, some_motion(), 0.0, centre);
  const RobustFit found = fit(matches);
  CHECK(found.fixed);
  CHECK(found.inliers.size() >= 30);
  CHECK((found.pose * centre - some_motion() * centre).norm() < 1e-6);
}

TEST_CASE("nothing, two matches, a line and one place fix no motion") {
  CHECK_FALSE(fit({}).fixed);
  CHECK_FALSE(fit(planted(2, 0, some_motion())).fixed);
  CHECK_FALSE(fit(std::vector<Match>(9, planted(1, 0, some_motion())[0])).fixed);
  auto line = planted(9, 0, some_motion());
  for (Match& match : line) {
    match.from = Eigen::Vector3d(match.from.x(), 0.0, 0.0);
    match.to = some_motion() * match.from;
  }
  CHECK_FALSE(fit(line).fixed);
}

TEST_CASE("matches that agree on nothing, and those that are no numbers, fix no motion") {
  CHECK_FALSE(fit(planted(0, 6, some_motion()), 1e-4).fixed);
  auto matches = planted(9, 0, some_motion());
  matches[3].to.x() = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(fit(matches).fixed);
}
