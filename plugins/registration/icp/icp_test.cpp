// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <numbers>
#include <velum/testing.hpp>

#include "geometry/motion.hpp"
#include "registration/test_data.hpp"

using velum::Cloud;
using velum::Index;
using velum::Points;
using velum::Pose;
using velum::test::Outcome;
using velum::test::Stage;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A square sheet with hills, 1 m wide; no grid, for a grid shifted by a step fits itself again.
Cloud hills(Index side, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  velum::Random random(6);
  Points points(3, side * side);
  for (Index i = 0; i < points.cols(); ++i) {
    const auto x = static_cast<float>(random.uniform());
    const auto y = static_cast<float>(random.uniform());
    points.col(i) << x, y, 0.1F * std::sin(7.0F * x) * std::cos(5.0F * y) + 0.1F * x * x;
  }
  return Cloud(points, origin);
}

Pose motion(double degrees, const Eigen::Vector3d& shift) {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(degrees * kDegree, Eigen::Vector3d(1, 2, 3).normalized())
                      .toRotationMatrix();
  pose.translation() = shift;
  return pose;
}

const Pose& found(const Outcome& outcome) {
  return outcome.get<velum::Transform>().matrix;
}

velum::Transform as_transform(const Pose& pose) {
  velum::Transform transform;
  transform.matrix = pose;
  return transform;
}

Cloud with_normals(const Cloud& cloud) {
  return Stage("features.normals").run(cloud).cloud();
}

}  // namespace

TEST_CASE("a copy of itself is found to rounding, wherever the origin is") {
  for (const Eigen::Vector3d& origin :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4e5, 5e6, 100.0)}) {
    const Cloud target = hills(60, origin);
    Pose about = Pose::Identity();
    about.translation() = origin;
    const Pose truth = about * motion(2.0, {0.01, 0.01, -0.01}) * about.inverse();
    const auto outcome = Stage("registration.icp")
                             .set("iterations", "200")
                             .set("relative_change", "0")
                             .run(target.transformed(truth.inverse()), target);
    const auto miss = velum::geometry::difference(found(outcome), truth, truth.inverse() * origin);
    CHECK(miss.rotation < 1e-6);
    CHECK(miss.translation < 1e-6);
    CHECK(outcome.measure("rmse") < 1e-6);
    CHECK(outcome.measure("overlap") == 1.0);
  }
}

TEST_CASE("the cloud given back lies on the target") {
  const Cloud target = hills(40);
  const Outcome outcome = Stage("registration.icp")
                              .set("iterations", "100")
                              .set("relative_change", "0")
                              .run(target.transformed(motion(1.0, {0.005, 0, 0})), target);
  const Eigen::Vector3d p =
      outcome.cloud().origin() + outcome.cloud().positions().col(99).cast<double>();
  CHECK((p - target.positions().col(99).cast<double>()).norm() < 1e-5);
}

TEST_CASE("point to plane needs fewer steps, and normals") {
  const Cloud target = hills(60);
  const Cloud source = target.transformed(motion(3.0, {0.02, 0.0, 0.01}));
  const auto point = Stage("registration.icp").run(source, target);
  const auto plane =
      Stage("registration.icp").set("metric", "point_to_plane").run(source, with_normals(target));
  CHECK(plane.measure("iterations") < point.measure("iterations"));
  CHECK(plane.measure("rmse") < 1e-6);
  CHECK_THROWS_WITH(Stage("registration.icp").set("metric", "point_to_plane").run(source, target),
                    Catch::Contains("normals"));
}

TEST_CASE("the history is that of the thesis: error, change, motion and the barycentre's path") {
  const Cloud target = hills(60);
  const auto outcome =
      Stage("registration.icp").run(target.transformed(motion(3.0, {0.02, 0.0, 0.01})), target);
  const auto& table = outcome.get<velum::Table>();
  REQUIRE(table.size() == static_cast<std::size_t>(outcome.measure("iterations")) + 1);
  CHECK(table.number(1, "error") < table.number(0, "error"));
  CHECK(table.number(table.size() - 1, "error") == Approx(outcome.measure("fitness")));
  const Cloud& moved = outcome.cloud();
  const Eigen::Vector3d centre = moved.origin() + moved.positions().cast<double>().rowwise().mean();
  CHECK(table.number(table.size() - 1, "x") == Approx(centre.x()).epsilon(1e-5));
  CHECK(outcome.get<velum::Transform>().history.size() == table.size());
}

TEST_CASE("it starts from the transform that is wired") {
  const Cloud target = hills(40);
  const Pose truth = motion(120.0, {3.0, 2.0, 0.0});
  const Cloud source = target.transformed(truth.inverse());
  const auto outcome = Stage("registration.icp")
                           .set("relative_change", "0")
                           .set("iterations", "100")
                           .run(source, target, as_transform(motion(0.5, {0, 0, 0}) * truth));
  CHECK(velum::geometry::difference(found(outcome), truth).rotation < 1e-5);
}

TEST_CASE("from 120 degrees it settles at a wrong pose, and the error shows it (thesis F04)") {
  const Cloud target = hills(40);
  const Pose truth = motion(120.0, {0.3, 0.2, 0.0});
  const auto outcome = Stage("registration.icp")
                           .set("iterations", "100")
                           .run(target.transformed(truth.inverse()), target);
  CHECK(outcome.measure("rmse") > 0.01);
  CHECK(velum::geometry::difference(found(outcome), truth).rotation > 10.0 * kDegree);
}

TEST_CASE("clouds out of reach are refused with numbers") {
  const Cloud target = hills(20);
  CHECK_THROWS_WITH(Stage("registration.icp")
                        .set("max_distance", "100 mm")
                        .run(target.transformed(motion(0.0, {9, 0, 0})), target),
                    Catch::Contains("0 of 400 source points have a target point within 0.1 m"));
}

TEST_CASE("a flat target is reported to leave directions free") {
  Points points = Points::Zero(3, 400);
  for (Index i = 0; i < 400; ++i)
    points.col(i) << static_cast<float>(i % 20), static_cast<float>(i / 20), 0.0F;
  const auto outcome =
      Stage("registration.icp")
          .set("metric", "point_to_plane")
          .run(Cloud(points).transformed(motion(0.0, {0, 0, 0.1})), with_normals(Cloud(points)));
  CHECK(outcome.measure("weakest") < 1e-6);
  REQUIRE(outcome.warnings.size() >= 3);
  CHECK_THAT(outcome.warnings[0], Catch::Contains("hardly fix"));
}

TEST_CASE("bunny scans 000 and 045 come back from 10 degrees and 20 mm") {
  const auto pair = velum::registration::test::bunny("000", "045");
  if (!pair) {
    WARN("skipped: no shared data");
    return;
  }
  const Pose& truth = pair->truth;
  const Cloud target = with_normals(pair->target);
  const Cloud& source = pair->source;
  const Eigen::Vector3d middle =
      source.origin() + source.positions().cast<double>().rowwise().mean();
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0),
                                      Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, -1, 1)}) {
    Pose disturbance = Pose::Identity();
    disturbance.linear() = Eigen::AngleAxisd(10.0 * kDegree, axis.normalized()).toRotationMatrix();
    const Eigen::Vector3d there = truth * middle;
    disturbance.translation() = there - disturbance.linear() * there + 0.02 * axis.unitOrthogonal();
    const auto outcome = Stage("registration.icp")
                             .set("metric", "point_to_plane")
                             .set("keep", "0.75")
                             .set("levels", "3")
                             .set("iterations", "60")
                             .set("relative_change", "1e-4")
                             .run(source, target, as_transform(disturbance * truth));
    const auto miss = velum::geometry::difference(found(outcome), truth, middle);
    INFO("axis " << axis.transpose() << ": " << miss.rotation / kDegree << " deg, "
                 << 1e3 * miss.translation << " mm");
    CHECK(miss.rotation < 0.5 * kDegree);
    CHECK(miss.translation < 0.5e-3);
  }
}

TEST_CASE("the small_gicp pair is registered from where it is") {
  const auto pair = velum::registration::test::street();
  if (!pair) {
    WARN("skipped: no shared data");
    return;
  }
  const auto outcome = Stage("registration.icp")
                           .set("metric", "point_to_plane")
                           .set("max_distance", "1 m")
                           .set("keep", "0.9")
                           .set("relative_change", "1e-4")
                           .run(pair->source, with_normals(pair->target));
  const auto miss = velum::geometry::difference(found(outcome), pair->truth);
  INFO(miss.rotation / kDegree << " deg, " << miss.translation << " m");
  CHECK(miss.rotation < 0.5 * kDegree);
  CHECK(miss.translation < 0.1);
}

TEST_CASE("the symmetric metric and compatible normals need normals of both") {
  const Cloud target = hills(60);
  const Cloud source = target.transformed(motion(3.0, {0.02, 0.0, 0.01}));
  for (const auto& [name, value] :
       {std::pair("metric", "symmetric"), std::pair("correspondences", "compatible_normals")}) {
    CHECK_THROWS_WITH(Stage("registration.icp").set(name, value).run(source, with_normals(target)),
                      Catch::Contains("normals"));
    const auto outcome = Stage("registration.icp")
                             .set(name, value)
                             .set("relative_change", "0")
                             .set("iterations", "200")
                             .run(with_normals(source), with_normals(target));
    CHECK(outcome.measure("rmse") < 1e-5);
  }
}

TEST_CASE("the covariance and the directions come out as tables and measures") {
  const Cloud target = with_normals(hills(60));
  const auto outcome = Stage("registration.icp")
                           .set("metric", "point_to_plane")
                           .run(hills(40).transformed(motion(1.0, {0.01, 0.0, 0.01})), target);
  CHECK(outcome.measure("free_directions") == 0.0);
  CHECK(outcome.measure("deviation_translation") > 0.0);
  CHECK(outcome.measure("deviation_translation") < 2e-3);
  const auto& directions = std::get<velum::Table>(*outcome.results.at(3));
  const auto& covariance = std::get<velum::Table>(*outcome.results.at(4));
  REQUIRE(directions.size() == 6);
  CHECK(directions.number(0, "strength") == Approx(outcome.measure("weakest")));
  CHECK(directions.number(5, "deviation") < directions.number(0, "deviation"));
  REQUIRE(covariance.size() == 6);
  CHECK(covariance.number(3, "shift_y") == Approx(covariance.number(4, "shift_x")));
  CHECK(std::sqrt(covariance.number(3, "shift_x")) <= outcome.measure("deviation_translation"));
}

TEST_CASE("a solver that does not fit the metric is refused with the one that does") {
  const Cloud target = with_normals(hills(20));
  CHECK_THROWS_WITH(Stage("registration.icp")
                        .set("metric", "point_to_plane")
                        .set("solver", "svd")
                        .run(target, target),
                    Catch::Contains("solver svd is for metric point_to_point"));
}

TEST_CASE("it ends when the steps are small enough") {
  const Cloud target = with_normals(hills(60));
  const auto outcome = Stage("registration.icp")
                           .set("metric", "point_to_plane")
                           .set("relative_change", "0")
                           .set("iterations", "100")
                           .set("still_angle", "0.01 deg")
                           .set("still_shift", "0.1 mm")
                           .run(hills(40).transformed(motion(2.0, {0.01, 0.0, 0.01})), target);
  CHECK(outcome.measure("iterations") < 40);
  CHECK(outcome.warnings.empty());
}

TEST_CASE("a third of an overlap is enough with planes, a kernel and a limit (thesis 3.17, 3.21)") {
  const Cloud whole = with_normals(hills(110));
  std::vector<std::int32_t> left;
  std::vector<std::int32_t> right;
  for (Index i = 0; i < whole.size(); ++i) {
    // Every other point, so that no point of one is in the other.
    if (i % 2 == 0 && whole.positions()(0, i) < 0.6F) left.push_back(static_cast<std::int32_t>(i));
    if (i % 2 == 1 && whole.positions()(0, i) > 0.4F) right.push_back(static_cast<std::int32_t>(i));
  }
  const Pose truth = motion(4.0, {0.03, -0.02, 0.02});
  const Cloud source = whole.select(left).transformed(truth.inverse());
  const auto miss = [&](Stage stage) {
    const auto outcome = stage.set("iterations", "100").run(source, whole.select(right));
    return velum::geometry::difference(found(outcome), truth).translation;
  };
  CHECK(miss(Stage("registration.icp")) > 0.02);
  CHECK(miss(Stage("registration.icp")
                 .set("metric", "symmetric")
                 .set("max_distance", "0.1 m")
                 .set("kernel", "tukey")
                 .set("relative_change", "1e-6")) < 2e-3);
}

TEST_CASE("ICP keeps to the promises of every stage") {
  using Settings = std::map<std::string, std::string>;
  for (const Settings& settings :
       {Settings{}, Settings{{"metric", "point_to_plane"}},
        Settings{{"metric", "symmetric"}, {"kernel", "tukey"}},
        Settings{{"correspondences", "reciprocal"}, {"solver", "helical"}, {"keep", "0.8"}},
        Settings{{"sampling", "random"}, {"levels", "2"}, {"kernel", "huber"}}})
    for (const auto& fault : velum::test::conformance("registration.icp", settings))
      FAIL_CHECK((settings.empty() ? "defaults" : settings.begin()->second) << ": " << fault);
}
