// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Index;
using velum::Mesh;
using velum::Points;
using velum::Table;
using velum::test::Stage;

namespace {

constexpr Index kSide = 31;

Cloud grid(double height, double slope) {
  Points points(3, kSide * kSide);
  for (Index i = 0; i < points.cols(); ++i) {
    const double x = 0.02 * static_cast<double>(i % kSide);
    points.col(i) =
        Eigen::Vector3d(x, 0.02 * static_cast<double>(i / kSide), height + slope * x).cast<float>();
  }
  return Cloud(std::move(points));
}

// A level square of 0.6 m, normals up.
Mesh square() {
  velum::Triangles triangles(3, 2 * (kSide - 1) * (kSide - 1));
  Index t = 0;
  for (std::int32_t j = 0; j + 1 < kSide; ++j)
    for (std::int32_t i = 0; i + 1 < kSide; ++i) {
      const auto a = static_cast<std::int32_t>(j * kSide + i);
      const auto b = static_cast<std::int32_t>(a + kSide);
      triangles.col(t++) << a, a + 1, b + 1;
      triangles.col(t++) << a, b + 1, b;
    }
  return {grid(0.0, 0.0), std::move(triangles)};
}

Stage stage() {
  return Stage("analysis.cloud_to_mesh");
}

}  // namespace

TEST_CASE("a lifted sheet is as far away as it was lifted, wherever its points lie") {
  Points between = grid(0.004, 0.0).positions();
  between.topRows(2) *= 0.93F;
  const auto out = stage().run(Cloud(between), square());
  for (const char* name : {"mean", "rms", "median", "p95", "max", "hausdorff", "height_mean"})
    CHECK(out.measure(name) == Approx(0.004));
}

TEST_CASE("behind the mesh the height is negative") {
  const auto out = stage().run(grid(-0.004, 0.0), square());
  CHECK(out.measure("rms") == Approx(0.004));
  CHECK(out.measure("height_mean") == Approx(-0.004));
  CHECK(out.cloud().column("height").vector<float>()[100] == Approx(-0.004F));
  CHECK(out.cloud().column("distance").vector<float>()[100] == Approx(0.004F));
}

TEST_CASE("a tilted sheet deviates by its angle") {
  const auto out = stage().run(grid(0.0, 0.1), square());
  CHECK(out.measure("normal_median") == Approx(std::atan(0.1)).epsilon(1e-3));
}

TEST_CASE("beyond the border the distance is that to the border") {
  Points points(3, 3);
  points << 0.7F, 0.3F, 0.7F, 0.3F, -0.2F, 0.7F, 0.0F, 0.0F, 0.0F;
  const Cloud out = stage().run(Cloud(points), square()).cloud();
  const auto distance = out.column("distance").vector<float>();
  CHECK(distance[0] == Approx(0.1F));
  CHECK(distance[1] == Approx(0.2F));
  CHECK(distance[2] == Approx(0.1414F).epsilon(1e-3));
}

TEST_CASE("on a round body normals and curvature agree with the mesh's") {
  // An arc of a cylinder of radius 0.5 m, cut into flat strips of 3 degrees, and points in the
  // middle of the strips: the strips' own normals would be right there and wrong at their edges.
  const auto on_arc = [](double degrees, double y) {
    const double a = degrees * std::numbers::pi / 180.0;
    return Eigen::Vector3d(0.5 * std::sin(a), y, 0.5 * std::cos(a));
  };
  Points corners(3, 21 * 11);
  Points points(3, 80 * 10);
  for (Index i = 0; i < corners.cols(); ++i)
    corners.col(i) =
        on_arc(3.0 * static_cast<double>(i / 11), 0.05 * static_cast<double>(i % 11)).cast<float>();
  for (Index i = 0; i < points.cols(); ++i)
    points.col(i) =
        on_arc(0.74 * static_cast<double>(i / 10) + 0.3, 0.05 * static_cast<double>(i % 10) + 0.02)
            .cast<float>();
  velum::Triangles triangles(3, 400);
  for (std::int32_t i = 0, t = 0; i < 20; ++i)
    for (std::int32_t j = 0; j < 10; ++j) {
      const std::int32_t a = 11 * i + j;
      triangles.col(t++) << a, a + 12, a + 1;
      triangles.col(t++) << a, a + 11, a + 12;
    }
  const auto out =
      stage().set("radius", "0.1 m").run(Cloud(points), Mesh(Cloud(corners), triangles));
  CHECK(out.measure("max") < 0.0004);
  CHECK(out.measure("normal_median") < 0.01);
  CHECK(out.measure("curvature_median") < 0.002);
}

TEST_CASE("histograms count every point") {
  const auto out = stage().set("bins", "5").run(grid(0.004, 0.0), square());
  const Table& table = out.get<Table>();
  REQUIRE(table.size() == 15);
  double points = 0.0;
  for (std::size_t i = 0; i < 5; ++i) points += table.number(i, "points");
  CHECK(points == static_cast<double>(kSide * kSide));
}

TEST_CASE("a mesh and a cloud of other origins are compared where they are") {
  const Cloud far = grid(0.004, 0.0).with_origin(Eigen::Vector3d(2.0, 1.0, -4.0));
  CHECK(stage().run(far, square()).measure("rms") == Approx(0.004).epsilon(1e-3));
}

TEST_CASE("triangles without area do no harm") {
  velum::Triangles triangles(3, 2);
  triangles << 0, 5, 1, 5, kSide, 5;
  const auto out = stage().run(grid(0.01, 0.0), Mesh(grid(0.0, 0.0), triangles));
  CHECK(std::isfinite(out.measure("normal_max")));
  CHECK(out.measure("max") > 0.1);
}

TEST_CASE("nothing cannot be compared") {
  CHECK_THROWS_AS(stage().run(Cloud(), square()), velum::Error);
  CHECK_THROWS_WITH(stage().run(grid(0.0, 0.0), Mesh()), Catch::Contains("no triangles"));
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("analysis.cloud_to_mesh")) FAIL_CHECK(fault);
}
