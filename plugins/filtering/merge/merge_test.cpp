// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Index;
using velum::Points;
using velum::Value;
using velum::test::Stage;

namespace {

Cloud some(Index n, float x, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  Points points = Points::Zero(3, n);
  for (Index i = 0; i < n; ++i) points.col(i) << x, static_cast<float>(i), 0.0F;
  velum::Sensor sensor;
  sensor.name = "at " + std::to_string(static_cast<int>(x));
  sensor.pose.translation() = origin + Eigen::Vector3d(x, 0, 5);
  return Cloud(points, origin)
      .with("label", velum::Column(Eigen::VectorXi::Constant(n, static_cast<int>(x)).eval()))
      .with_sensors({sensor});
}

velum::test::Outcome merged(std::vector<Value> clouds) {
  return Stage("filtering.merge").in_many(std::move(clouds)).run();
}

}  // namespace

TEST_CASE("points stand in the order of the clouds") {
  const auto outcome = merged({some(3, 1), some(2, 2)});
  REQUIRE(outcome.cloud().size() == 5);
  CHECK(outcome.cloud().positions()(0, 2) == 1.0F);
  CHECK(outcome.cloud().positions()(0, 3) == 2.0F);
  CHECK(outcome.cloud().labels()[4] == 2);
  CHECK(outcome.measure("points") == 5.0);
  CHECK(outcome.warnings.empty());
}

TEST_CASE("one cloud stays what it is") {
  const auto outcome = merged({some(3, 1)});
  CHECK(outcome.cloud().size() == 3);
  CHECK(outcome.cloud().has("label"));
}

TEST_CASE("every point keeps the sensor that saw it") {
  const Cloud cloud = merged({some(3, 1), some(2, 2)}).cloud();
  REQUIRE(cloud.sensors().size() == 2);
  CHECK(cloud.sensor_of(0) == 0U);
  CHECK(cloud.sensor_of(4) == 1U);
  CHECK(cloud.sensors()[1].name == "at 2");
}

TEST_CASE("a column that not all have is left out, and it says so") {
  const auto outcome = merged({some(3, 1), some(2, 2).without("label")});
  CHECK_FALSE(outcome.cloud().has("label"));
  REQUIRE(outcome.warnings.size() == 1);
  CHECK_THAT(outcome.warnings[0], Catch::Contains("'label'"));
}

TEST_CASE("columns of one name and different types are an error") {
  const Cloud one =
      some(3, 1).with("mark", velum::Column(Eigen::VectorXi(Eigen::VectorXi::Zero(3))));
  const Cloud other =
      some(2, 2).with("mark", velum::Column(Eigen::VectorXf(Eigen::VectorXf::Zero(2))));
  CHECK_THROWS_AS(merged({one, other}), velum::Error);
}

TEST_CASE("clouds about different origins come together in the right place") {
  const Cloud cloud = merged({some(2, 1), some(2, 2, {100.0, 0.0, 0.0})}).cloud();
  const Eigen::Vector3d last = cloud.origin() + cloud.positions().col(3).cast<double>();
  CHECK((last - Eigen::Vector3d(102.0, 1.0, 0.0)).norm() < 1e-6);
}

TEST_CASE("an empty cloud adds nothing") {
  const auto outcome = merged({some(3, 1), some(0, 2)});
  CHECK(outcome.cloud().size() == 3);
}

TEST_CASE("merging keeps to the promises of every stage") {
  for (const auto& fault : velum::test::conformance("filtering.merge")) FAIL_CHECK(fault);
}
