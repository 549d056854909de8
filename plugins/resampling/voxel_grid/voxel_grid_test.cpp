// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Column;
using velum::Index;
using velum::Points;
using velum::test::Stage;

namespace {

// Four points in the cell [0, 1)³ and one in [1, 2) × [0, 1)².
Cloud five() {
  Points points(3, 5);
  points << 0.1F, 0.4F, 0.9F, 0.6F, 1.5F, 0.1F, 0.5F, 0.9F, 0.9F, 0.5F, 0.1F, 0.5F, 0.9F, 0.5F,
      0.2F;
  return Cloud(std::move(points));
}

Stage stage(const char* size = "1 m") {
  Stage made("resampling.voxel_grid");
  made.set("size", size);
  return made;
}

}  // namespace

TEST_CASE("the mean of each cell") {
  const auto out = stage().run(five());
  REQUIRE(out.cloud().size() == 2);
  CHECK(out.cloud().positions().col(0).isApprox(Eigen::Vector3f(0.5F, 0.6F, 0.5F), 1e-6F));
  CHECK(out.cloud().positions().col(1).isApprox(Eigen::Vector3f(1.5F, 0.5F, 0.2F)));
  CHECK(out.measure("kept") == 2.0);
  CHECK(out.measure("points_per_cell") == 2.5);
}

TEST_CASE("the measured point nearest to the centre") {
  const Cloud out = stage().set("point", "nearest").run(five()).cloud();
  REQUIRE(out.size() == 2);
  CHECK(out.positions().col(0) == Eigen::Vector3f(0.4F, 0.5F, 0.5F));
}

TEST_CASE("cells with few points go") {
  const Cloud out = stage().set("min_points", "2").run(five()).cloud();
  REQUIRE(out.size() == 1);
  CHECK(out.positions()(0, 0) == Approx(0.5F));
}

TEST_CASE("columns are averaged or come from the nearest point") {
  Eigen::VectorXf intensity(5);
  intensity << 1, 2, 3, 6, 10;
  velum::VectorXu8 sensor(5);
  sensor << 0, 1, 0, 0, 1;
  Eigen::Matrix<std::uint8_t, 3, Eigen::Dynamic> colour(3, 5);
  colour.setConstant(10);
  colour(0, 0) = 14;
  Eigen::VectorXi label(5);
  label << 4, 7, 4, 4, 9;
  const Cloud in = five()
                       .with("intensity", Column(intensity))
                       .with("colour", Column(colour))
                       .with("sensor", Column(sensor))
                       .with("label", Column(label));
  const Cloud out = stage().run(in).cloud();
  CHECK(out.intensity()[0] == Approx(3.0F));
  CHECK(out.column("colour").as<std::uint8_t>()(0, 0) == 11);
  CHECK(out.labels()[0] == 7);
  CHECK(out.column("sensor").vector<std::uint8_t>()[0] == 1);
  CHECK(out.intensity()[1] == Approx(10.0F));
}

TEST_CASE("normals of either sign are averaged as directions") {
  Points normals = Points::Zero(3, 5);
  normals.row(2).setOnes();
  normals(2, 0) = -1.0F;
  normals.col(2) = Eigen::Vector3f(0.6F, 0.0F, 0.8F);
  const Cloud out = stage().run(five().with("normals", Column(normals))).cloud();
  CHECK(out.normals().col(0).norm() == Approx(1.0F));
  CHECK(out.normals().col(0).isApprox(Eigen::Vector3f(0.6F, 0.0F, 3.8F).normalized(), 1e-5F));
}

TEST_CASE("cells are those of true coordinates, whatever the origin") {
  const Eigen::Vector3d origin(4e5 + 0.25, 5e6, 100.0);
  const Cloud moved = five().with_origin(Eigen::Vector3d(-0.25, 0.0, 0.0));
  const Cloud plain = stage().run(five()).cloud();
  const Cloud same = stage().run(moved).cloud();
  REQUIRE(same.size() == plain.size());
  for (Index i = 0; i < plain.size(); ++i)
    CHECK((same.positions().col(i).cast<double>() + same.origin() -
           plain.positions().col(i).cast<double>())
              .norm() < 1e-6);
  Points shifted = five().positions();
  const Cloud far = stage().run(Cloud(shifted, origin)).cloud();
  CHECK(far.origin() == origin);
  // 0.25 m farther, the points at 0.9 and 1.5 m share a cell.
  CHECK(far.size() == 2);
  CHECK(far.positions().col(1).isApprox(Eigen::Vector3f(1.2F, 0.7F, 0.55F), 1e-5F));
}

TEST_CASE("noise falls with the number of points in a cell") {
  // 400 cells of 100 points each, the sheet half-way up in them.
  velum::Random random(2);
  Points points(3, 40000);
  for (Index i = 0; i < points.cols(); ++i)
    points.col(i) =
        Eigen::Vector3d(random.uniform(), random.uniform(), 0.525 + 0.004 * random.gaussian())
            .cast<float>();
  const Cloud out = stage("50 mm").run(Cloud(points)).cloud();
  CHECK(out.size() == 400);
  const auto heights = out.positions().row(2).cast<double>().array() - 0.525;
  CHECK(std::sqrt(heights.square().mean()) == Approx(0.0004).epsilon(0.15));
}

TEST_CASE("a size too small for the extent is refused") {
  CHECK_THROWS_WITH(stage("1e-7 m").run(five()), Catch::Contains("too small"));
  CHECK_THROWS_AS(Stage("resampling.voxel_grid").run(five()), velum::Error);
  CHECK_THROWS_AS(stage("0 m"), velum::Error);
}

TEST_CASE("origin and sensors stay") {
  const Cloud in = five().with_sensors({velum::Sensor{}});
  CHECK(stage().run(in).cloud().sensors().size() == 1);
}

TEST_CASE("conformance") {
  for (const char* point : {"mean", "nearest"})
    for (const auto& fault :
         velum::test::conformance("resampling.voxel_grid", {{"size", "0.3"}, {"point", point}}))
      FAIL_CHECK(fault);
}
