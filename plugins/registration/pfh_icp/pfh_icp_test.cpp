// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <velum/testing.hpp>

#include "registration/test_surfaces.hpp"

using namespace velum::registration::test;
using velum::Cloud;
using velum::Index;
using velum::Points;
using velum::Pose;
using velum::Transform;
using velum::test::Outcome;
using velum::test::Stage;

namespace {

/// A floor of 60 m with a ball, a pipe and a cone on it, after the thesis's figure 3.13, those
/// points with x <= `high`; sampled anew for every seed.
Cloud shapes(std::uint64_t seed, double high = 99.0) {
  velum::Random random(seed);
  std::vector<Eigen::Vector3f> found;
  const auto put = [&](double x, double y, double z) {
    if (x <= high) found.push_back(Eigen::Vector3d(x, y, z).cast<float>());
  };
  const auto turn = [&] { return random.uniform(0.0, 2.0 * std::numbers::pi); };
  for (int i = 0; i < 7200; ++i) {
    const double x = random.uniform(-10.0, 50.0);
    put(x, random.uniform(-10.0, 50.0), 0.0);
  }
  for (int i = 0; i < 4000; ++i) {
    const double z = random.uniform(-1.0, 1.0);
    const double a = turn();
    const double r = std::sqrt(1.0 - z * z);
    put(10.0 + 8.0 * r * std::cos(a), 8.0 + 8.0 * r * std::sin(a), 12.0 + 8.0 * z);
  }
  for (int i = 0; i < 3200; ++i) {
    const double a = turn();
    put(35.0 + 5.0 * std::cos(a), 12.0 + 5.0 * std::sin(a), random.uniform(2.0, 22.0));
  }
  for (int i = 0; i < 2200; ++i) {
    const double a = turn();
    const double h = std::sqrt(random.uniform());
    put(22.0 + 7.0 * h * std::cos(a), 36.0 + 7.0 * h * std::sin(a), 20.0 - 16.0 * h);
  }
  Points points(3, static_cast<Index>(found.size()));
  for (std::size_t i = 0; i < found.size(); ++i) points.col(static_cast<Index>(i)) = found[i];
  return Cloud(std::move(points));
}

/// Degrees about Y through the scene's middle: the thesis's first test turns by 30 (equation 3.28).
Pose about_y(double degrees, const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) {
  const Eigen::Vector3d middle(20.0, 20.0, 6.0);
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(degrees * kDegree, Eigen::Vector3d::UnitY()).toRotationMatrix();
  pose.translation() = middle - pose.linear() * middle + shift;
  return pose;
}

velum::geometry::Difference miss(const Outcome& outcome, const Pose& off) {
  return velum::geometry::difference(outcome.get<Transform>().matrix, off.inverse(),
                                     off * Eigen::Vector3d(20.0, 20.0, 6.0));
}

Stage stage() {
  return Stage("registration.pfh_icp");
}

}  // namespace

TEST_CASE("the thesis's scene turned by 30 degrees, scanned again, comes back (table 3.6)") {
  const Pose off = about_y(30.0);
  const Cloud source = shapes(2).transformed(off);
  const Outcome outcome = stage().run(source, shapes(1));
  const auto left = miss(outcome, off);
  INFO(left.rotation / kDegree << " deg, " << left.translation << " m");
  CHECK(left.rotation < 0.4 * kDegree);
  CHECK(left.translation < 0.15);
  CHECK(outcome.measure("overlap") > 0.98);
  CHECK(outcome.measure("weakest") > 0.01);
  CHECK(outcome.warnings.empty());
}

TEST_CASE("the steps tell the way: fewer pairs and less error while partners come nearer") {
  const Pose off = about_y(20.0, {2.0, -3.0, 1.0});
  const Outcome outcome = stage().run(shapes(2).transformed(off), shapes(1));
  const auto& history = outcome.get<velum::Table>();
  CHECK(miss(outcome, off).translation < 0.15);
  REQUIRE(static_cast<double>(history.size()) == outcome.measure("iterations") + 1.0);
  const std::size_t end = history.size() - 1;
  CHECK(history.number(end, "pairs") < history.number(0, "pairs"));
  CHECK(history.number(end, "pairs") == outcome.measure("pairs"));
  CHECK(history.number(end, "error") < 0.05 * history.number(0, "error"));
  CHECK(outcome.get<Transform>().history.size() == history.size());
  const Eigen::Vector3d centre =
      outcome.cloud().origin() + outcome.cloud().positions().cast<double>().rowwise().mean();
  // The history follows the thinned cloud, which has another barycentre.
  CHECK(std::abs(history.number(end, "x") - centre.x()) < 3.0);
}

TEST_CASE("a part of the scene against all of it (thesis table 3.18)") {
  const Pose off = about_y(30.0);
  const Outcome outcome = stage().run(shapes(2, 23.0).transformed(off), shapes(1));
  const auto left = miss(outcome, off);
  INFO(left.rotation / kDegree << " deg, " << left.translation << " m");
  CHECK(left.rotation < 1.0 * kDegree);
  CHECK(left.translation < 0.4);
}

TEST_CASE("it starts where it is told, far from zero, and keeps the columns") {
  Pose there = Pose::Identity();
  there.translation() << 4e5, 5e6, 100.0;
  const auto brought = [&](const Cloud& cloud) {
    return Cloud(Points(cloud.positions()), there.translation());
  };
  const Pose truth = there * turned(120.0, {300.0, 200.0, 0.0}) * there.inverse();
  Transform start;
  start.matrix = there * about_y(6.0) * there.inverse() * truth;
  const Cloud scene = brought(shapes(2));
  const Cloud source =
      scene.with("intensity", velum::Column(Eigen::VectorXf::Ones(scene.size()).eval()))
          .transformed(truth.inverse());
  const Outcome outcome = stage().run(source, brought(shapes(1)), start);
  CHECK(outcome.cloud().has("intensity"));
  for (const Index i : {Index{7}, Index{9000}}) {
    const Eigen::Vector3d p =
        outcome.cloud().origin() + outcome.cloud().positions().col(i).cast<double>();
    const Eigen::Vector3d known = scene.origin() + scene.positions().col(i).cast<double>();
    CHECK((p - known).norm() < 0.3);
    const Eigen::Vector3d before = source.origin() + source.positions().col(i).cast<double>();
    CHECK((outcome.get<Transform>().matrix * before - p).norm() < 1e-3);
  }
}

TEST_CASE("another seed draws other partners and ends at the same place") {
  const Pose off = about_y(15.0);
  const Cloud source = shapes(2).transformed(off);
  const Outcome first = stage().seed(1).run(source, shapes(1));
  const Outcome second = stage().seed(2).run(source, shapes(1));
  CHECK(first.get<Transform>().matrix.matrix() != second.get<Transform>().matrix.matrix());
  CHECK(miss(first, off).translation < 0.15);
  CHECK(miss(second, off).translation < 0.15);
}

TEST_CASE("a start that max_distance does not reach is refused or seen in the overlap") {
  const Pose off = about_y(120.0);
  double overlap = 0.0;
  try {
    overlap = stage()
                  .set("max_distance", "3 m")
                  .run(shapes(2).transformed(off), shapes(1))
                  .measure("overlap");
  } catch (const velum::Error&) {
  }
  CHECK(overlap < 0.7);
}

TEST_CASE("clouds that are too far apart are refused") {
  CHECK_THROWS_WITH(stage().run(shapes(2).transformed(about_y(0.0, {500.0, 0.0, 0.0})), shapes(1)),
                    Catch::Contains("12 pairs are needed"));
}

TEST_CASE("too few points are refused with their number, and points all in one place") {
  const Cloud scene = shapes(1);
  const std::vector<std::int32_t> three{0, 1, 2};
  CHECK_THROWS_WITH(stage().run(scene.select(three), scene),
                    Catch::Contains("the source has 3 points"));
  CHECK_THROWS_WITH(stage().run(scene, scene.select(three)),
                    Catch::Contains("the target has 3 points"));
  CHECK_THROWS_WITH(stage().set("resolution", "1 km").run(scene, scene),
                    Catch::Contains("12 pairs are needed"));
  CHECK_THROWS_AS(stage().run(Cloud(Points(Points::Ones(3, 100))), scene), velum::Error);
}

TEST_CASE("a level floor leaves its sliding free, and a warning says so") {
  const Outcome outcome = stage().run(flat(60), flat(60));
  CHECK(outcome.measure("weakest") < 1e-3);
  REQUIRE(outcome.warnings.size() >= 3);
  CHECK_THAT(outcome.warnings[0], Catch::Contains("the pairs hardly fix"));
}

TEST_CASE("too few iterations are reported") {
  const Outcome outcome =
      stage().set("iterations", "2").run(shapes(2).transformed(about_y(20.0)), shapes(1));
  CHECK(outcome.measure("iterations") == 2.0);
  REQUIRE_FALSE(outcome.warnings.empty());
  CHECK_THAT(outcome.warnings.back(), Catch::Contains("ended after 2 iterations"));
}

TEST_CASE("registering by histograms ends when interrupted") {
  CHECK_THROWS_AS(stage().cancelled().run(shapes(2), shapes(1)), velum::Cancelled);
}

TEST_CASE("registering by histograms keeps to the promises of every stage") {
  for (const auto& fault : velum::test::conformance("registration.pfh_icp")) FAIL_CHECK(fault);
}
