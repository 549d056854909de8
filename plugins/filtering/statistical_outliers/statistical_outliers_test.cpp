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

Cloud grid(Index side) {
  Points points = Points::Zero(3, side * side);
  for (Index i = 0; i < side * side; ++i)
    points.col(i) = Eigen::Vector3f(static_cast<float>(i % side), static_cast<float>(i / side), 0);
  return Cloud(std::move(points));
}

Cloud with_stray(const Cloud& cloud, const Eigen::Vector3f& stray) {
  Points points(3, cloud.size() + 1);
  points << cloud.positions(), stray;
  return Cloud(std::move(points));
}

Stage stage(const char* neighbours, const char* deviations) {
  Stage made("filtering.statistical_outliers");
  made.set("neighbours", neighbours).set("deviations", deviations);
  return made;
}

}  // namespace

TEST_CASE("a stray point goes") {
  const auto outcome = stage("8", "3").run(with_stray(grid(20), {10.0F, 10.0F, 8.0F}));
  CHECK(outcome.measure("removed") == 1.0);
  CHECK(outcome.cloud().positions().row(2).maxCoeff() == 0.0F);
}

TEST_CASE("the limit is mean plus so many standard deviations") {
  // Three points on a line, one neighbour each: distances 1, 1, 3.
  Points points = Points::Zero(3, 3);
  points.row(0) << 0.0F, 1.0F, 4.0F;
  const auto outcome = stage("1", "1").run(Cloud(std::move(points)));
  CHECK(outcome.measure("mean_distance") == Approx(5.0 / 3.0));
  CHECK(outcome.measure("limit") == Approx(5.0 / 3.0 + std::sqrt(4.0 / 3.0)));
  CHECK(outcome.cloud().size() == 2);
}

TEST_CASE("a perfectly regular cloud loses nothing") {
  Points ring(3, 100);
  for (Index i = 0; i < 100; ++i) {
    const double angle = 2.0 * 3.14159265358979 * static_cast<double>(i) / 100.0;
    ring.col(i) = Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0).cast<float>();
  }
  CHECK(stage("2", "0").run(Cloud(std::move(ring))).measure("removed") == 0.0);
}

TEST_CASE("more deviations remove less") {
  velum::Random random(3);
  Points points(3, 2000);
  for (float& x : points.reshaped()) x = static_cast<float>(random.gaussian());
  const Cloud cloud(std::move(points));
  const double strict = stage("10", "1").run(cloud).measure("removed");
  const double lenient = stage("10", "3").run(cloud).measure("removed");
  CHECK(strict > lenient);
  CHECK(lenient > 0.0);
}

TEST_CASE("fewer points than neighbours are no problem") {
  CHECK(stage("50", "2").run(grid(2)).cloud().size() == 4);
}

TEST_CASE("columns and sensors stay") {
  Cloud in = with_stray(grid(20), {10.0F, 10.0F, 8.0F}).with_sensors({velum::Sensor{}});
  in = in.with("label", velum::Column(Eigen::VectorXi::LinSpaced(401, 0, 400).eval()));
  const Cloud out = stage("8", "3").run(in).cloud();
  CHECK(out.sensors().size() == 1);
  CHECK(out.labels()[399] == 399);
}

TEST_CASE("the origin does not matter") {
  const Cloud near = with_stray(grid(20), {10.0F, 10.0F, 8.0F});
  const Cloud far(Points(near.positions()), Eigen::Vector3d(4e5, 5e6, 100));
  CHECK(stage("8", "3").run(far).cloud().size() == stage("8", "3").run(near).cloud().size());
}

TEST_CASE("no neighbours, or less than no deviations, are refused") {
  CHECK_THROWS_AS(Stage("filtering.statistical_outliers").set("neighbours", "0"), velum::Error);
  CHECK_THROWS_AS(Stage("filtering.statistical_outliers").set("deviations", "-1"), velum::Error);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("filtering.statistical_outliers"))
    FAIL_CHECK(fault);
}
