// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Index;
using velum::Points;
using velum::test::Stage;

namespace {

Cloud sphere(Index count) {
  velum::Random random(2);
  Points points(3, count);
  for (Index i = 0; i < count; ++i)
    points.col(i) = Eigen::Vector3d(random.gaussian(), random.gaussian(), random.gaussian())
                        .normalized()
                        .cast<float>();
  return Cloud(std::move(points));
}

Cloud floor() {
  Points points(3, 400);
  for (Index i = 0; i < 400; ++i)
    points.col(i) << static_cast<float>(i % 20), static_cast<float>(i / 20), 1.0F;
  return Cloud(std::move(points));
}

}  // namespace

TEST_CASE("the normals of a plane are exact, its curvature zero") {
  const Cloud found = Stage("features.pcl_normals").run(floor()).cloud();
  CHECK((found.normals().row(2).array() < -0.9999F).all());
  CHECK(found.curvature().maxCoeff() < 1e-5F);
}

TEST_CASE("normals face the sensor, without one the origin") {
  velum::Sensor sensor;
  sensor.pose.translation() << 10.0, 10.0, 50.0;
  const Cloud found = Stage("features.pcl_normals").run(floor().with_sensors({sensor})).cloud();
  CHECK((found.normals().row(2).array() > 0.9999F).all());
}

TEST_CASE("the normals of a sphere point to its middle, as ours do") {
  const Cloud ball = sphere(4000);
  const Cloud theirs = Stage("features.pcl_normals").set("neighbours", "20").run(ball).cloud();
  const Cloud ours = Stage("features.normals").set("neighbours", "20").run(ball).cloud();
  for (Index i = 0; i < ball.size(); ++i) {
    REQUIRE(theirs.normals().col(i).dot(-ball.positions().col(i)) > 0.98F);
    REQUIRE(theirs.normals().col(i).dot(ours.normals().col(i)) > 0.999F);
  }
}

TEST_CASE("a radius serves as well") {
  const Cloud found = Stage("features.pcl_normals").set("radius", "2.5").run(floor()).cloud();
  CHECK((found.normals().row(2).array() < -0.9999F).all());
}

TEST_CASE("a point alone within the radius is counted, its normal faces the sensor") {
  Points points = floor().positions();
  points.col(0) << 500.0F, 0.0F, 0.0F;
  const auto outcome = Stage("features.pcl_normals").set("radius", "2.5").run(Cloud(points));
  CHECK(outcome.measure("degenerate") == 1.0);
  CHECK(outcome.cloud().normals()(0, 0) == Approx(-1.0F));
  CHECK(outcome.warnings.size() == 1);
}

TEST_CASE("columns stay") {
  const Cloud cloud = floor().with("intensity", velum::Column(Eigen::VectorXf::Ones(400).eval()));
  CHECK(Stage("features.pcl_normals").run(cloud).cloud().has("intensity"));
}

TEST_CASE("both neighbours and radius, or fewer than three neighbours, are refused") {
  CHECK_THROWS_WITH(
      Stage("features.pcl_normals").set("neighbours", "9").set("radius", "1").run(floor()),
      Catch::Contains("one of them"));
  CHECK_THROWS_AS(Stage("features.pcl_normals").set("neighbours", "2"), velum::Error);
}

TEST_CASE("pcl_normals keeps to the promises of every stage") {
  for (const auto& fault : velum::test::conformance("features.pcl_normals")) FAIL_CHECK(fault);
}
