// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <numbers>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Points;
using velum::test::Stage;

namespace {

Cloud one(const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  Points points(3, 2);
  points << 1.0F, 0.0F, 0.0F, 2.0F, 0.0F, 0.0F;
  Points normals(3, 2);
  normals << 1.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F;
  velum::Sensor sensor;
  sensor.pose.translation() = origin + Eigen::Vector3d(0, 0, 3);
  return Cloud(points, origin)
      .with(velum::column::kNormals, velum::Column(normals))
      .with_sensors({sensor});
}

Eigen::Vector3d place(const Cloud& cloud, velum::Index i) {
  return cloud.origin() + cloud.positions().col(i).cast<double>();
}

velum::Transform quarter() {
  velum::Transform transform;
  transform.matrix.linear() =
      Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  transform.matrix.translation() << 10, 0, 0;
  return transform;
}

}  // namespace

TEST_CASE("a wired transform moves positions, normals and sensors") {
  const auto outcome = Stage("filtering.transform").run(one(), quarter());
  CHECK(place(outcome.cloud(), 0).isApprox(Eigen::Vector3d(10, 1, 0), 1e-6));
  CHECK(outcome.cloud().normals().col(0).isApprox(Eigen::Vector3f(0, 1, 0), 1e-6F));
  CHECK(outcome.cloud().sensors()[0].pose.translation().isApprox(Eigen::Vector3d(10, 0, 3)));
  CHECK(outcome.measure("rotation") == Approx(std::numbers::pi / 2));
  CHECK(outcome.measure("translation") == Approx(10.0));
}

TEST_CASE("the inverse undoes it") {
  const Cloud there = Stage("filtering.transform").run(one(), quarter()).cloud();
  const Cloud back =
      Stage("filtering.transform").set("inverse", "true").run(there, quarter()).cloud();
  CHECK((place(back, 1) - place(one(), 1)).norm() < 1e-6);
}

TEST_CASE("axis and angle, then translation") {
  const auto outcome = Stage("filtering.transform")
                           .set("axis", "[0, 0, 2]")
                           .set("angle", "90 deg")
                           .set("translation", "[\"10 m\", 0, 0]")
                           .run(one());
  CHECK(place(outcome.cloud(), 0).isApprox(Eigen::Vector3d(10, 1, 0), 1e-6));
}

TEST_CASE("roll, pitch and yaw turn about the fixed axes, in that order") {
  const auto outcome = Stage("filtering.transform").set("rpy", "[90, 0, 90]").run(one());
  CHECK((place(outcome.cloud(), 0) - Eigen::Vector3d(0, 1, 0)).norm() < 1e-6);
  CHECK((place(outcome.cloud(), 1) - Eigen::Vector3d(0, 0, 2)).norm() < 1e-6);
}

TEST_CASE("a matrix of sixteen numbers") {
  const auto outcome = Stage("filtering.transform")
                           .set("matrix", "[0.0,-1,0,10, 1,0,0,0, 0,0,1,0, 0,0,0,1]")
                           .run(one());
  CHECK(place(outcome.cloud(), 0).isApprox(Eigen::Vector3d(10, 1, 0), 1e-6));
}

TEST_CASE("without anything given nothing moves") {
  const auto outcome = Stage("filtering.transform").run(one());
  CHECK(outcome.cloud().positions() == one().positions());
}

TEST_CASE("what is wrong with the parameters is said") {
  const auto refused = [](const char* name, const char* value, const char* words) {
    CHECK_THROWS_WITH(Stage("filtering.transform").set(name, value).run(one()),
                      Catch::Contains(words));
  };
  refused("matrix", "[1.0, 0, 0]", "3 numbers");
  refused("matrix", "[2.0,0,0,0, 0,2,0,0, 0,0,2,0, 0,0,0,1]", "not a rigid motion");
  refused("matrix", "[1.0,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,0,1]", "not a rigid motion");
  refused("matrix", "[1.0,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,1,1]", "not a rigid motion");
  refused("rpy", "[1, 2]", "2 angles");
  refused("axis", "[0, 0, 0]", "no length");
  CHECK_THROWS_WITH(Stage("filtering.transform").set("axis", "[0, 0, 1]").run(one(), quarter()),
                    Catch::Contains("given twice"));
  CHECK_THROWS_WITH(
      Stage("filtering.transform").set("axis", "[0, 0, 1]").set("rpy", "[1, 2, 3]").run(one()),
      Catch::Contains("given twice"));
}

TEST_CASE("a cloud far from its frame's origin turns about that origin without losing digits") {
  const Eigen::Vector3d far(4e5, 5e6, 100.0);
  const Cloud moved = Stage("filtering.transform")
                          .set("axis", "[0, 0, 1]")
                          .set("angle", "90 deg")
                          .run(one(far))
                          .cloud();
  CHECK((place(moved, 0) - Eigen::Vector3d(-5e6, 4e5 + 1.0, 100.0)).norm() < 1e-5);
}

TEST_CASE("moving keeps to the promises of every stage") {
  for (const auto& fault : velum::test::conformance(
           "filtering.transform",
           {{"axis", "[1, 2, 3]"}, {"angle", "30 deg"}, {"translation", "[1, 2, 3]"}}))
    FAIL_CHECK(fault);
}
