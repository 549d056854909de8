// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Index;
using velum::Points;
using velum::test::Stage;

namespace {

// The integer places of a cube of side 5, from (0, 0, 0) to (4, 4, 4).
Cloud cube(const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  Points points(3, 125);
  for (Index i = 0; i < 125; ++i)
    points.col(i) = Eigen::Vector3f(static_cast<float>(i % 5), static_cast<float>(i / 5 % 5),
                                    static_cast<float>(i / 25));
  return Cloud(std::move(points), origin);
}

Stage stage() {
  return Stage("filtering.region_of_interest");
}

}  // namespace

TEST_CASE("a box keeps what lies within, borders included") {
  const auto outcome = stage().set("min", "[1, 1, 1]").set("max", "[2, 3, 4]").run(cube());
  CHECK(outcome.cloud().size() == 2 * 3 * 4);
  CHECK(outcome.measure("removed") == 125.0 - 24.0);
}

TEST_CASE("one corner alone is half a space") {
  CHECK(stage().set("min", "[2, 0, 0]").run(cube()).cloud().size() == 75);
  CHECK(stage().set("max", "[4, 4, 0]").run(cube()).cloud().size() == 25);
}

TEST_CASE("a ball keeps what lies within") {
  CHECK(stage().set("centre", "[2, 2, 2]").set("radius", "1").run(cube()).cloud().size() == 7);
}

TEST_CASE("outside keeps everything else") {
  Stage ball = stage().set("centre", "[2, 2, 2]").set("radius", "1").set("keep", "outside");
  CHECK(ball.run(cube()).cloud().size() == 118);
}

TEST_CASE("box and ball together keep what both hold") {
  Stage both = stage().set("centre", "[2, 2, 2]").set("radius", "1").set("min", "[2, 2, 2]");
  CHECK(both.run(cube()).cloud().size() == 4);
}

TEST_CASE("places are absolute: the origin counts") {
  const Cloud far = cube({4e5, 5e6, 0});
  CHECK(stage().set("min", "[400003, 5000000, 0]").run(far).cloud().size() == 50);
  CHECK(stage().set("max", "[4, 4, 4]").run(far).cloud().empty());
}

TEST_CASE("ranges are counted from the sensor that saw the point") {
  velum::Sensor other;
  other.pose.translation() = Eigen::Vector3d(4, 4, 4);
  Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 1> seen_by(125);
  seen_by.setZero();
  const Cloud cloud = cube().with_sensors({velum::Sensor{}, other});
  CHECK(stage().set("max_range", "1").run(cloud).cloud().size() == 4);
  seen_by[124] = 1;
  const Cloud two = cloud.with("sensor", velum::Column(seen_by));
  CHECK(stage().set("max_range", "1").run(two).cloud().size() == 5);
  CHECK(stage().set("min_range", "6.9").run(two).cloud().empty());
}

TEST_CASE("columns stay with their points") {
  const Cloud in =
      cube().with("label", velum::Column(Eigen::VectorXi::LinSpaced(125, 0, 124).eval()));
  const Cloud out = stage().set("min", "[0, 0, 4]").run(in).cloud();
  CHECK(out.labels()[0] == 100);
  CHECK(out.labels()[24] == 124);
}

TEST_CASE("regions that make no sense are refused") {
  CHECK_THROWS_AS(stage().run(cube()), velum::Error);
  CHECK_THROWS_AS(stage().set("centre", "[0, 0, 0]").run(cube()), velum::Error);
  CHECK_THROWS_AS(stage().set("min", "[1, 1, 1]").set("max", "[2, 0, 2]").run(cube()),
                  velum::Error);
  CHECK_THROWS_AS(stage().set("max_range", "1").run(cube()), velum::Error);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance(
           "filtering.region_of_interest", {{"min", "[-1, -1, -1]"}, {"max", "[1, 1, 1]"}}))
    FAIL_CHECK(fault);
}
