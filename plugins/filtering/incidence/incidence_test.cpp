// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Index;
using velum::Points;
using velum::test::Stage;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// A floor 2 m below a scanner at the origin of the axes: the point i degrees off the plumb line is
// met at i degrees.
Cloud floor_of(Index count) {
  Points points(3, count);
  Points normals(3, count);
  for (Index i = 0; i < count; ++i) {
    points.col(i) << static_cast<float>(2.0 * std::tan(static_cast<double>(i) * kDegree)), 0, -2;
    normals.col(i) << 0, 0, 1;
  }
  return Cloud(std::move(points)).with("normals", velum::Column(std::move(normals)));
}

Stage stage(const char* angle, const char* action = "remove") {
  Stage made("filtering.incidence");
  made.set("angle", angle).set("action", action);
  return made;
}

}  // namespace

TEST_CASE("70 degrees are the limit unless said otherwise") {
  const auto outcome = Stage("filtering.incidence").run(floor_of(86));
  CHECK(outcome.cloud().size() == 71);
  CHECK(outcome.measure("removed") == 15.0);
  CHECK(outcome.measure("grazing") == 15.0);
  CHECK(outcome.measure("largest") == Approx(85.0 * kDegree));
}

TEST_CASE("the column says the angle") {
  const Cloud cloud = stage("80 deg").run(floor_of(90)).cloud();
  REQUIRE(cloud.size() == 81);
  const auto angles = cloud.column("incidence").vector<float>();
  for (Index i = 0; i < cloud.size(); ++i)
    CHECK(angles[i] == Approx(static_cast<double>(i) * kDegree).margin(1e-6));
}

TEST_CASE("marked returns stay") {
  const Cloud cloud = stage("30 deg", "mark").run(floor_of(60)).cloud();
  REQUIRE(cloud.size() == 60);
  const auto grazing = cloud.column("grazing").vector<std::uint8_t>();
  for (Index i = 0; i < 60; ++i) CHECK(grazing[i] == (i > 30 ? 1 : 0));
}

TEST_CASE("removed returns leave no mark") {
  CHECK_FALSE(stage("30 deg").run(floor_of(60)).cloud().has("grazing"));
}

TEST_CASE("a normal and its opposite are one") {
  const Cloud up = floor_of(60);
  const Cloud down = up.with("normals", velum::Column(Points(-up.normals())));
  CHECK(stage("30 deg").run(down).cloud().size() == 31);
}

TEST_CASE("each return is judged from the scanner that saw it") {
  Points points = Points::Zero(3, 2);
  Points normals(3, 2);
  normals << 0, 0, 0, 0, 1, 1;
  velum::Sensor above;
  above.pose.translation() << 0, 0, 3;
  velum::Sensor beside;
  beside.pose.translation() << 10, 0, 0.1;
  velum::VectorXu8 sensor(2);
  sensor << 0, 1;
  const Cloud cloud = Cloud(std::move(points))
                          .with("normals", velum::Column(std::move(normals)))
                          .with("sensor", velum::Column(sensor))
                          .with_sensors({above, beside});
  const Cloud out = stage("70 deg", "mark").run(cloud).cloud();
  CHECK(out.column("grazing").vector<std::uint8_t>()[0] == 0);
  CHECK(out.column("grazing").vector<std::uint8_t>()[1] == 1);
  CHECK(out.column("incidence").vector<float>()[1] == Approx(std::atan2(10.0, 0.1)));
}

TEST_CASE("large coordinates lose nothing") {
  velum::Sensor sensor;
  sensor.pose.translation() << 4e5, 5e6, 0;
  const Cloud near = floor_of(86);
  const Cloud far = Cloud(Points(near.positions()), Eigen::Vector3d(4e5, 5e6, 0))
                        .with("normals", near.column("normals"))
                        .with_sensors({sensor});
  CHECK(Stage("filtering.incidence").run(far).cloud().size() == 71);
}

TEST_CASE("columns and sensors stay") {
  const Cloud in = floor_of(86)
                       .with_sensors({velum::Sensor{}})
                       .with("label", velum::Column(Eigen::VectorXi::LinSpaced(86, 0, 85).eval()));
  const Cloud out = Stage("filtering.incidence").run(in).cloud();
  CHECK(out.sensors().size() == 1);
  CHECK(out.labels()[70] == 70);
}

TEST_CASE("without normals it cannot be said") {
  CHECK_THROWS_AS(Stage("filtering.incidence").run(Cloud(Points(Points::Random(3, 9)))),
                  velum::Error);
}

TEST_CASE("more than a right angle is refused") {
  CHECK_THROWS_AS(stage("91 deg"), velum::Error);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("filtering.incidence")) FAIL_CHECK(fault);
}
