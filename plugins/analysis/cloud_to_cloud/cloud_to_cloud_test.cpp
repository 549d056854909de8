// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Index;
using velum::Points;
using velum::Table;
using velum::test::Stage;

namespace {

constexpr Index kSide = 40;

// A sheet z = height + slope x of 40 × 40 points 10 mm apart, seen from above.
Cloud sheet(double height, double slope = 0.0) {
  Points points(3, kSide * kSide);
  for (Index i = 0; i < points.cols(); ++i) {
    const double x = 0.01 * static_cast<double>(i % kSide);
    points.col(i) =
        Eigen::Vector3d(x, 0.01 * static_cast<double>(i / kSide), height + slope * x).cast<float>();
  }
  velum::Sensor above;
  above.pose.translation() = Eigen::Vector3d(0.2, 0.2, 5.0);
  return Cloud(std::move(points)).with_sensors({above});
}

Stage stage() {
  return Stage("analysis.cloud_to_cloud");
}

}  // namespace

TEST_CASE("a lifted sheet is as far away as it was lifted") {
  const auto out = stage().run(sheet(0.003), sheet(0.0));
  for (const char* name : {"mean", "rms", "median", "p95", "max", "hausdorff", "back_rms"})
    CHECK(out.measure(name) == Approx(0.003));
  CHECK(out.measure("normal_max") < 1e-4);
  CHECK(out.measure("curvature_max") < 1e-6);
}

TEST_CASE("a tilted sheet deviates by its angle") {
  const auto out = stage().run(sheet(0.0, 0.1), sheet(0.0));
  CHECK(out.measure("normal_mean") == Approx(std::atan(0.1)).epsilon(1e-3));
  const auto angle = out.cloud().column("normal_deviation").vector<float>();
  CHECK(angle[800] == Approx(std::atan(0.1)).epsilon(1e-3));
}

TEST_CASE("the sign of a normal does not count") {
  Points up = Points::Zero(3, kSide * kSide);
  up.row(2).setOnes();
  const Cloud flat =
      sheet(0.0).with("curvature", velum::Column(Eigen::VectorXf::Zero(up.cols()).eval()));
  const Cloud turned = flat.with("normals", velum::Column(Points(-up)));
  const auto out = stage().run(turned, flat.with("normals", velum::Column(up)));
  CHECK(out.measure("normal_max") == 0.0);
}

TEST_CASE("columns that the clouds have are used, unless a radius is given") {
  const Index n = kSide * kSide;
  Points along = Points::Zero(3, n);
  along.row(0).setOnes();
  const Cloud odd =
      sheet(0.0)
          .with("normals", velum::Column(along))
          .with("curvature", velum::Column(Eigen::VectorXf::Constant(n, 0.2F).eval()));
  const auto own = stage().run(odd, sheet(0.0));
  CHECK(own.measure("normal_mean") == Approx(1.5708).epsilon(1e-3));
  CHECK(own.measure("curvature_mean") == Approx(0.2).epsilon(1e-3));
  const auto made = stage().set("radius", "40 mm").run(odd, sheet(0.0));
  CHECK(made.measure("normal_mean") < 1e-4);
  CHECK(made.measure("curvature_mean") < 1e-6);
}

TEST_CASE("the greatest distance either way") {
  const Cloud whole = sheet(0.0);
  std::vector<std::int32_t> half;
  for (Index i = 0; i < whole.size(); ++i)
    if (i % kSide < kSide / 2) half.push_back(static_cast<std::int32_t>(i));
  const auto out = stage().run(whole.select(half), whole);
  CHECK(out.measure("max") == 0.0);
  CHECK(out.measure("hausdorff") == Approx(0.2));
}

TEST_CASE("histograms count every point") {
  const auto out = stage().set("bins", "4").set("limit", "2 mm").run(sheet(0.003), sheet(0.0));
  const Table& table = out.get<Table>();
  REQUIRE(table.size() == 12);
  for (std::size_t quantity = 0; quantity < 3; ++quantity) {
    double points = 0.0;
    for (std::size_t i = 0; i < 4; ++i) points += table.number(4 * quantity + i, "points");
    CHECK(points == static_cast<double>(kSide * kSide));
  }
  // All lie beyond the limit, in the last range.
  CHECK(table.number(3, "share") == Approx(100.0));
  CHECK(table.number(3, "from") == Approx(0.0015));
  CHECK(table.number(3, "to") == Approx(0.003));
}

TEST_CASE("smoothing brings noise, normals and curvature nearer to the truth") {
  velum::Random random(4);
  Points noisy = sheet(0.0, 0.1).positions();
  for (Index i = 0; i < noisy.cols(); ++i)
    noisy(2, i) += static_cast<float>(0.004 * random.gaussian());
  const Cloud rough = sheet(0.0, 0.1).with_positions(std::move(noisy));
  const Cloud smooth = Stage("resampling.mls").set("radius", "60 mm").run(rough).cloud();
  const auto before = stage().set("radius", "40 mm").run(rough, sheet(0.0, 0.1));
  const auto after = stage().set("radius", "40 mm").run(smooth, sheet(0.0, 0.1));
  CHECK(after.measure("normal_rms") < 0.6 * before.measure("normal_rms"));
  CHECK(after.measure("curvature_rms") < 0.5 * before.measure("curvature_rms"));
  CHECK(after.measure("rms") < before.measure("rms"));
}

TEST_CASE("the input keeps its columns, and other origins do not matter") {
  const Cloud far = sheet(0.003).with_origin(Eigen::Vector3d(3.0, 4.0, 5.0));
  const auto out =
      stage().run(far.with("label", velum::Column(Eigen::VectorXi::Constant(far.size(), 7).eval())),
                  sheet(0.0));
  CHECK(out.cloud().labels()[3] == 7);
  CHECK_FALSE(out.cloud().has("normals"));
  CHECK(out.measure("rms") == Approx(0.003).epsilon(1e-3));
}

TEST_CASE("nothing cannot be compared") {
  CHECK_THROWS_AS(stage().run(Cloud(), sheet(0.0)), velum::Error);
  CHECK_THROWS_WITH(stage().run(sheet(0.0), Cloud()), Catch::Contains("reference"));
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("analysis.cloud_to_cloud")) FAIL_CHECK(fault);
}
