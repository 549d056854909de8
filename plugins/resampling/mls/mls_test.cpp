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

constexpr Index kSide = 60;
constexpr double kStep = 0.02;

// A sheet z = x²/(2R) of 1.18 m a side, sampled every 20 mm, with noise along z; row i is along y.
Cloud sheet(double radius, double noise) {
  velum::Random random(7);
  Points points(3, kSide * kSide);
  for (Index i = 0; i < points.cols(); ++i) {
    const double x = static_cast<double>(i / kSide) * kStep;
    const double y = static_cast<double>(i % kSide) * kStep;
    points.col(i) =
        Eigen::Vector3d(x, y, x * x / (2.0 * radius) + noise * random.gaussian()).cast<float>();
  }
  velum::Sensor above;
  above.pose.translation() = Eigen::Vector3d(0.5, 0.5, 5.0);
  return Cloud(std::move(points)).with_sensors({above});
}

bool inside(Index i, Index margin) {
  const Index x = i / kSide, y = i % kSide;
  return x >= margin && y >= margin && x < kSide - margin && y < kSide - margin;
}

// Root mean square height [m] over the sheet of the points that are `margin` rows from its border.
double error(const Cloud& cloud, double radius, Index margin) {
  double squares = 0.0;
  Index count = 0;
  for (Index i = 0; i < cloud.size(); ++i) {
    if (!inside(i, margin)) continue;
    const Eigen::Vector3d p = cloud.positions().col(i).cast<double>();
    const double slope = p.x() / radius;
    const double height = (p.z() - p.x() * p.x() / (2.0 * radius)) / std::hypot(1.0, slope);
    squares += height * height;
    ++count;
  }
  return std::sqrt(squares / static_cast<double>(count));
}

double border_length(const Cloud& cloud) {
  const auto at = [&](Index x, Index y) -> Eigen::Vector3d {
    return cloud.positions().col(x * kSide + y).cast<double>();
  };
  double length = 0.0;
  for (Index i = 1; i < kSide; ++i) {
    length += (at(i, 0) - at(i - 1, 0)).norm() + (at(0, i) - at(0, i - 1)).norm();
    length += (at(i, kSide - 1) - at(i - 1, kSide - 1)).norm();
    length += (at(kSide - 1, i) - at(kSide - 1, i - 1)).norm();
  }
  return length;
}

Stage stage(const char* radius = "80 mm") {
  Stage made("resampling.mls");
  made.set("radius", radius);
  return made;
}

}  // namespace

TEST_CASE("noise falls below three tenths inside a curved sheet") {
  const auto outcome = stage().run(sheet(2.0, 0.004));
  CHECK(error(sheet(2.0, 0.004), 2.0, 5) == Approx(0.004).epsilon(0.1));
  CHECK(error(outcome.cloud(), 2.0, 5) < 0.3 * 0.004);
  CHECK(outcome.measure("moved_rms") == Approx(0.0035).epsilon(0.1));
}

TEST_CASE("a surface of the polynomial's order is met exactly") {
  for (const char* order : {"2", "3"}) {
    const Cloud out = stage().set("order", order).run(sheet(2.0, 0.0)).cloud();
    CHECK(error(out, 2.0, 0) < 5e-5);
  }
  CHECK(error(stage().set("order", "1").run(sheet(1e9, 0.0)).cloud(), 1e9, 0) < 1e-6);
}

TEST_CASE("a low order flattens what a high order keeps") {
  const auto bias = [](const char* order) {
    return error(stage("150 mm").set("order", order).run(sheet(1.0, 0.0)).cloud(), 1.0, 8);
  };
  CHECK(bias("0") > 1e-3);
  CHECK(bias("1") > 1e-3);
  CHECK(bias("2") < 1e-4);
}

TEST_CASE("the border stays where it is") {
  const Cloud in = sheet(2.0, 0.0);
  const Cloud out = stage().run(in).cloud();
  CHECK(border_length(out) == Approx(border_length(in)).epsilon(0.002));
  double farthest = 0.0;
  for (Index i = 0; i < in.size(); ++i)
    if (!inside(i, 1))
      farthest = std::max(
          farthest, static_cast<double>((out.positions().col(i) - in.positions().col(i)).norm()));
  CHECK(farthest < 1e-3);
}

TEST_CASE("points move along the surface's normal only, at the border too") {
  const Cloud in = sheet(1e9, 0.004);
  const Cloud out = stage().run(in).cloud();
  double sideways = 0.0;
  for (Index i = 0; i < in.size(); ++i)
    sideways = std::max(
        sideways,
        static_cast<double>((out.positions().col(i) - in.positions().col(i)).head<2>().norm()));
  CHECK(sideways < 0.002);
  CHECK(error(out, 1e9, 0) < 0.5 * 0.004);
}

TEST_CASE("normals and curvature are those of the smooth surface") {
  const Cloud out = stage().run(sheet(2.0, 0.004)).cloud();
  for (Index i = 0; i < out.size(); ++i) {
    if (!inside(i, 5)) continue;
    const double x = out.positions()(0, i);
    const Eigen::Vector3d truth = Eigen::Vector3d(-x / 2.0, 0.0, 1.0).normalized();
    REQUIRE(out.normals().col(i).cast<double>().dot(truth) > std::cos(0.1));
  }
  const Cloud exact = stage().run(sheet(2.0, 0.0)).cloud();
  CHECK(exact.curvature().maxCoeff() < 1e-3F);
  CHECK(out.curvature().mean() < 2e-3F);
}

TEST_CASE("a large radius on a dense cloud gives what all neighbours would") {
  // 20 mm of spacing against 300 mm: about 700 neighbours, so means of cells stand for them.
  const Cloud out = stage("300 mm").run(sheet(2.0, 0.004)).cloud();
  CHECK(error(out, 2.0, 16) < 0.1 * 0.004);
  CHECK(error(out, 2.0, 0) < 0.4 * 0.004);
}

TEST_CASE("points with too few neighbours are kept or dropped") {
  const Cloud in = velum::merge(std::vector<Cloud>{
      sheet(2.0, 0.0),
      Cloud(Points(Points::Constant(3, 1, 9.0F))).with_sensors({velum::Sensor{}})});
  const auto kept = stage().run(in);
  CHECK(kept.cloud().size() == in.size());
  CHECK(kept.measure("few") == 1.0);
  CHECK(kept.warnings.size() == 1);
  CHECK(kept.cloud().positions().col(in.size() - 1) == in.positions().col(in.size() - 1));
  CHECK(stage().set("few", "drop").run(in).cloud().size() == in.size() - 1);
}

TEST_CASE("other columns, origin and sensors stay") {
  const Cloud flat = sheet(2.0, 0.004);
  Cloud in(Points(flat.positions()), Eigen::Vector3d(4e5, 5e6, 0));
  in = in.with_sensors(flat.sensors())
           .with("label", velum::Column(Eigen::VectorXi::Constant(flat.size(), 3).eval()));
  const Cloud out = stage().run(in).cloud();
  CHECK(out.origin() == in.origin());
  CHECK(out.sensors().size() == 1);
  CHECK(out.labels()[17] == 3);
}

TEST_CASE("a narrower weight smooths less") {
  const Cloud in = sheet(2.0, 0.004);
  const double wide = error(stage().run(in).cloud(), 2.0, 5);
  const double narrow = error(stage().set("gaussian", "30 mm").run(in).cloud(), 2.0, 5);
  CHECK(narrow > wide);
}

TEST_CASE("a missing radius and an order above three are refused") {
  CHECK_THROWS_AS(Stage("resampling.mls").run(sheet(2.0, 0.0)), velum::Error);
  CHECK_THROWS_AS(stage().set("order", "4"), velum::Error);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("resampling.mls", {{"radius", "0.3"}}))
    FAIL_CHECK(fault);
}
