// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Index;
using velum::Points;
using velum::test::Stage;

namespace {

// A wall at y = 5 m, seen from the origin with range noise along y.
Cloud wall(Index side, double step, double noise) {
  velum::Random random(1);
  Points points(3, side * side);
  for (Index i = 0; i < side; ++i)
    for (Index j = 0; j < side; ++j)
      points.col(i * side + j) =
          Eigen::Vector3d(static_cast<double>(i) * step, 5.0 + noise * random.gaussian(),
                          static_cast<double>(j) * step)
              .cast<float>();
  return Cloud(std::move(points)).with_sensors({velum::Sensor{}});
}

Cloud sphere(Index count, double radius) {
  velum::Random random(2);
  Points points(3, count);
  for (Index i = 0; i < count; ++i) {
    const Eigen::Vector3d p(random.gaussian(), random.gaussian(), random.gaussian());
    points.col(i) = (radius * p.normalized()).cast<float>();
  }
  return Cloud(std::move(points));
}

// Root mean square angle [rad] between normals and a direction, signs aside.
double error_against(const Cloud& cloud, const Eigen::Vector3f& truth) {
  double squares = 0.0;
  for (Index i = 0; i < cloud.size(); ++i) {
    const double angle =
        std::asin(std::min(1.0, static_cast<double>(cloud.normals().col(i).cross(truth).norm())));
    squares += angle * angle;
  }
  return std::sqrt(squares / static_cast<double>(cloud.size()));
}

constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace

TEST_CASE("the normals of an exact plane are exact and its curvature is zero") {
  for (const char* setting : {"neighbours", "radius"}) {
    Stage stage("features.normals");
    stage.set(setting, std::string(setting) == "radius" ? "0.12" : "12");
    const Cloud cloud = stage.run(wall(20, 0.05, 0.0)).cloud();
    CHECK(error_against(cloud, Eigen::Vector3f::UnitY()) < 1e-5);
    CHECK(cloud.curvature().maxCoeff() < 1e-9F);
  }
}

TEST_CASE("normals point to the sensor that saw the point") {
  const Cloud plane = wall(20, 0.05, 0.0);
  velum::Sensor behind;
  behind.pose.translation() = Eigen::Vector3d(0.5, 10.0, 0.5);
  Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 1> seen_by(plane.size());
  for (Index i = 0; i < seen_by.size(); ++i) seen_by[i] = static_cast<std::uint8_t>(i % 2);
  const Cloud cloud =
      Stage("features.normals")
          .set("neighbours", "10")
          .run(plane.with_sensors({velum::Sensor{}, behind}).with("sensor", velum::Column(seen_by)))
          .cloud();
  for (Index i = 0; i < cloud.size(); ++i)
    REQUIRE(cloud.normals()(1, i) == Approx(i % 2 == 0 ? -1.0 : 1.0));
}

TEST_CASE("without a sensor normals point to the origin of the axes") {
  const Cloud ball = sphere(2000, 2.0);
  const Cloud cloud = Stage("features.normals").set("neighbours", "12").run(ball).cloud();
  for (Index i = 0; i < cloud.size(); ++i)
    REQUIRE(cloud.normals().col(i).dot(ball.positions().col(i)) < 0.0F);
  const Eigen::Vector3d far(0.0, 0.0, 1e6);
  const Cloud moved(Points(ball.positions()), far);
  const Cloud seen = Stage("features.normals").set("neighbours", "12").run(moved).cloud();
  for (Index i = 0; i < seen.size(); ++i) REQUIRE(seen.normals()(2, i) < 0.01F);
}

TEST_CASE("curvature is the share of the smallest eigenvalue") {
  // A cap of half angle a on a sphere: heights vary by (ρ²/2R), ρ² uniform over the disc, so
  // λ0 = ρ⁴/(48R²) and λ1 = λ2 = ρ²/4.
  const Cloud cloud =
      Stage("features.normals").set("radius", "0.4").run(sphere(60000, 2.0)).cloud();
  const double expected = (std::pow(0.4, 4) / (48 * 4.0)) / (0.4 * 0.4 / 2.0);
  CHECK(cloud.curvature().mean() == Approx(expected).epsilon(0.03));
}

TEST_CASE("the automatic choice reaches its accuracy where a fixed number measures noise") {
  const Cloud dense = wall(150, 0.003, 0.004);
  const auto fixed = Stage("features.normals").set("neighbours", "50").run(dense);
  const auto automatic = Stage("features.normals").run(dense);
  CHECK(error_against(fixed.cloud(), Eigen::Vector3f::UnitY()) > 5 * kDegree);
  CHECK(error_against(automatic.cloud(), Eigen::Vector3f::UnitY()) < 2 * kDegree);
  CHECK(automatic.measure("noise") == Approx(0.004).epsilon(0.15));
}

TEST_CASE("the automatic choice stays small on a sparse scan") {
  const auto outcome = Stage("features.normals").set("noise", "4 mm").run(wall(40, 0.07, 0.004));
  CHECK(outcome.measure("neighbours") < 20.0);
  CHECK(error_against(outcome.cloud(), Eigen::Vector3f::UnitY()) < 2 * kDegree);
}

TEST_CASE("the automatic choice does not reach around an edge") {
  // Two walls at a right angle: the automatic neighbourhood shrinks towards the edge.
  const Cloud one = wall(60, 0.01, 0.002);
  Points other(3, one.size());
  for (Index i = 0; i < one.size(); ++i) {
    const Eigen::Vector3f p = one.positions().col(i);
    other.col(i) = Eigen::Vector3f(p.y() - 5.0F, 5.0F - p.x() - 0.01F, p.z());
  }
  const Cloud both = velum::merge(std::vector<Cloud>{one, Cloud(std::move(other))});
  const Cloud cloud = Stage("features.normals").set("noise", "2 mm").run(both).cloud();
  Index wrong = 0;
  for (Index i = 0; i < one.size(); ++i)
    if (one.positions()(0, i) > 0.025F && std::abs(cloud.normals()(1, i)) < 0.94F) ++wrong;
  CHECK(wrong < one.size() / 50);
}

TEST_CASE("other columns, origin and sensors stay") {
  const Cloud plane = wall(10, 0.1, 0.0);
  const Cloud in =
      plane.with("intensity", velum::Column(Eigen::VectorXf(plane.size()).setOnes().eval()));
  const Cloud out = Stage("features.normals").set("neighbours", "8").run(in).cloud();
  CHECK(out.has("intensity"));
  CHECK(out.sensors().size() == 1);
  CHECK(out.position_column().same_storage(in.position_column()));
}

TEST_CASE("points that fix no plane are counted and get a direction to the sensor") {
  Points line(3, 30);
  for (Index i = 0; i < line.cols(); ++i)
    line.col(i) = Eigen::Vector3f(static_cast<float>(i), 5.0F, 0.0F);
  const Cloud cloud = Cloud(std::move(line)).with_sensors({velum::Sensor{}});
  const auto outcome = Stage("features.normals").set("neighbours", "5").run(cloud);
  CHECK(outcome.measure("degenerate") == 30.0);
  REQUIRE(outcome.warnings.size() == 1);
  CHECK(outcome.warnings.front().find("30 of 30") != std::string::npos);
  for (Index i = 0; i < 30; ++i) CHECK(outcome.cloud().normals()(1, i) == Approx(-1.0));
}

TEST_CASE("neighbours and radius together are both bounds") {
  const Cloud plane = wall(30, 0.05, 0.0);
  const auto count = [&](Stage& stage) { return stage.run(plane).measure("neighbours"); };
  CHECK(count(Stage("features.normals").set("neighbours", "40")) == 40.0);
  CHECK(count(Stage("features.normals").set("neighbours", "40").set("radius", "0.051")) < 5.01);
  CHECK(count(Stage("features.normals").set("neighbours", "4").set("radius", "1")) == 4.0);
}

TEST_CASE("fewer than three neighbours are refused") {
  CHECK_THROWS_AS(Stage("features.normals").set("neighbours", "2"), velum::Error);
  CHECK_THROWS_AS(Stage("features.normals").set("radius", "0"), velum::Error);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("features.normals")) FAIL_CHECK(fault);
  for (const auto& fault : velum::test::conformance("features.normals", {{"neighbours", "10"}}))
    FAIL_CHECK(fault);
}
