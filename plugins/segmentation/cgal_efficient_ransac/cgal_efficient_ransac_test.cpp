// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT

#include <catch2/catch.hpp>
#include <cmath>

#include "shapes/test_hand_labels.hpp"
#include "shapes/test_scene.hpp"

using velum::Cloud;
using velum::Clusters;
using velum::Index;
using velum::Points;
using velum::test::Outcome;
using velum::test::Stage;

namespace {

Stage stage() {
  Stage made("segmentation.cgal_efficient_ransac");
  made.set("min_size", "500");
  return made;
}

const Cloud& scene() {
  static const Cloud cloud = velum::test::shapes_scene("4 mm");
  return cloud;
}

Points patch(Index side) {
  Points points(3, side * side);
  for (Index i = 0; i < points.cols(); ++i)
    points.col(i) =
        0.01F * Eigen::Vector3f(static_cast<float>(i % side), static_cast<float>(i / side), 0.0F);
  return points;
}

}  // namespace

TEST_CASE("a flat patch is one cluster, and its row in the table tells it") {
  const Cloud cloud =
      Stage("features.normals").set("neighbours", "9").run(Cloud(patch(40))).cloud();
  const Outcome outcome = stage().set("epsilon", "2 mm").set("gap", "0.05").run(cloud);
  const auto& found = outcome.get<Clusters>();
  REQUIRE(found.kinds.size() == 1);
  CHECK(found.kinds.number(0, "points") > 1500.0);
  CHECK(std::abs(found.kinds.number(0, "axis_z")) == Approx(1.0));
  CHECK(found.kinds.number(0, "rms") < 1e-4);
  CHECK(found.kinds.number(0, "length") == Approx(0.39).epsilon(0.05));
}

TEST_CASE("labels and the table agree, the largest first") {
  const Outcome outcome = stage().run(scene());
  const auto& found = outcome.get<Clusters>();
  for (std::size_t r = 0; r < found.kinds.size(); ++r) {
    CHECK(found.kinds.number(r, "cluster") == static_cast<double>(r));
    CHECK((found.label().array() == static_cast<int>(r)).count() ==
          static_cast<Index>(found.kinds.number(r, "points")));
    if (r > 0) CHECK(found.kinds.number(r, "points") <= found.kinds.number(r - 1, "points"));
  }
  CHECK(found.kinds.size() > 0);
}

TEST_CASE("nothing large enough leaves nothing, with a warning") {
  const Outcome outcome = stage().set("min_size", "20000").run(scene());
  CHECK(outcome.get<Clusters>().kinds.empty());
  REQUIRE(outcome.warnings.size() == 1);
  CHECK(outcome.warnings.front().find("min_size") != std::string::npos);
}

TEST_CASE("a cloud without normals is refused, an empty one gives nothing") {
  CHECK_THROWS_AS(stage().run(Cloud(patch(10))), velum::Error);
}

TEST_CASE("cancelled before it starts it does not run") {
  CHECK_THROWS_AS(stage().cancelled().run(scene()), velum::Cancelled);
}

TEST_CASE("the scene's shapes are found with their kinds and sizes") {
  const Outcome outcome = stage().run(scene());
  const auto& found = outcome.get<Clusters>();
  for (const auto& [label, share] : {std::pair{1, 0.97}, {2, 0.97}, {3, 0.95}, {4, 0.9}}) {
    const auto score = velum::test::score(found, label);
    INFO(label << ": recall " << score.recall() << " precision " << score.precision());
    CHECK(score.recall() > share);
    CHECK(score.precision() > 0.97);
  }
  const auto ball = static_cast<std::size_t>(velum::test::score(found, 2).cluster);
  CHECK(found.kinds.at(ball, "model") == velum::Cell(std::string("sphere")));
  CHECK(found.kinds.number(ball, "radius") == Approx(1.0).epsilon(0.01));
  CHECK(found.kinds.number(ball, "point_x") == Approx(-1.3).margin(0.01));
}

TEST_CASE("one kind alone can be sought") {
  const Outcome outcome = stage().set("model", "plane").run(scene());
  const auto& kinds = outcome.get<Clusters>().kinds;
  REQUIRE(kinds.size() >= 1);
  for (std::size_t r = 0; r < kinds.size(); ++r)
    CHECK(kinds.at(r, "model") == velum::Cell(std::string("plane")));
  CHECK(kinds.number(0, "point_z") == Approx(0.0).margin(0.002));
}

TEST_CASE("the same seed gives the same result") {
  const auto labels = [](std::uint64_t seed) {
    return Eigen::VectorXi(stage().seed(seed).run(scene()).get<Clusters>().label());
  };
  CHECK(labels(3) == labels(3));
}

TEST_CASE("airborne ground that people labelled (ISPRS) is met as the README says") {
  Stage made("segmentation.cgal_efficient_ransac");
  made.set("model", "plane").set("epsilon", "2 m");
  std::string faults;
  if (!velum::test::holds_on_terrain(
          made, {{"samp11", 0.252, 0.823}, {"samp22", 0.836, 0.891}, {"samp53", 0.339, 0.974}},
          faults))
    WARN("skipped: VELUM_SHARED has no ISPRS scans");
  INFO(faults);
  CHECK(faults.empty());
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("segmentation.cgal_efficient_ransac"))
    FAIL_CHECK(fault);
}
