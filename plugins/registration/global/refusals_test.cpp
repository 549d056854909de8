// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "test_trials.hpp"

using namespace velum::registration::test;
using velum::Cloud;
using velum::Index;
using velum::Points;
using velum::test::Stage;

TEST_CASE("without its planes the tunnel is refused, not turned the wrong way") {
  const Pair pair = tunnel();
  CHECK_THROWS_AS(Stage("registration.global")
                      .set("planes", "false")
                      .run(pair.source.transformed(random_frame(pair, 1)), pair.target),
                  velum::Error);
}

TEST_CASE("clouds that share nothing are refused") {
  const Cloud target = shapes(1, right_of(24.0));
  const Cloud source = shapes(2, left_of(23.0));
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    velum::Random random(seed);
    CHECK_THROWS_AS(Stage("registration.global")
                        .run(source.transformed(velum::test::random_pose(random, 60.0)), target),
                    velum::Error);
  }
}

TEST_CASE("what fixes no pose is refused") {
  velum::Random random(1);
  const auto made = [&](Index count, const auto& point) {
    Points points(3, count);
    for (Index i = 0; i < count; ++i) points.col(i) = point(i).template cast<float>();
    return Cloud(std::move(points));
  };
  const auto ball = [&](Index) {
    return Eigen::Vector3d(random.gaussian(), random.gaussian(), random.gaussian()).normalized();
  };
  const auto floor = [&](Index) {
    const double x = random.uniform();
    return Eigen::Vector3d(x, random.uniform(), 0.0);
  };
  const auto box = [&](Index i) {
    Eigen::Vector3d p(random.uniform(), random.uniform(), random.uniform());
    p[i % 3] = i % 2 == 0 ? 0.0 : 1.0;
    return p;
  };
  CHECK_THROWS_AS(Stage("registration.global").run(made(5000, ball), made(5000, ball)),
                  velum::Error);
  CHECK_THROWS_AS(Stage("registration.global").run(made(5000, floor), made(5000, floor)),
                  velum::Error);
  CHECK_THROWS_AS(Stage("registration.global").run(made(6000, box), made(6000, box)), velum::Error);
}

TEST_CASE("too few points are refused with their number") {
  CHECK_THROWS_WITH(Stage("registration.global").run(Cloud(Points::Random(3, 20)), shapes(1)),
                    Catch::Contains("the source has 20 points"));
}
