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
  Stage made("segmentation.pcl_ransac");
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
  const Outcome outcome = stage().set("epsilon", "2 mm").run(cloud);
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

TEST_CASE("plane, sphere and cylinder of the scene are found, the cone is not") {
  const auto found = [](const char* model) {
    return stage().set("model", model).set("shapes", "1").run(scene());
  };
  const auto plane = velum::test::score(found("plane").get<Clusters>(), 1);
  CHECK(plane.recall() > 0.97);
  CHECK(plane.precision() > 0.97);
  const Outcome ball = found("sphere");
  CHECK(velum::test::score(ball.get<Clusters>(), 2).recall() > 0.95);
  CHECK(ball.get<Clusters>().kinds.number(0, "radius") == Approx(1.0).epsilon(0.01));
  CHECK(ball.get<Clusters>().kinds.number(0, "point_z") == Approx(1.0).epsilon(0.01));
  const Outcome tube = found("cylinder");
  CHECK(velum::test::score(tube.get<Clusters>(), 3).recall() > 0.9);
  CHECK(tube.get<Clusters>().kinds.number(0, "radius") == Approx(0.6).epsilon(0.01));
  CHECK(velum::test::score(found("cone").get<Clusters>(), 4).recall() < 0.9);
}

TEST_CASE("shapes come one after another") {
  const Cloud& cloud = scene();
  CHECK(stage().set("shapes", "1").run(cloud).measure("clusters") == 1.0);
  const Outcome lower = stage().set("shapes", "2").set("min_size", "50").run(cloud);
  CHECK(lower.measure("clusters") == 2.0);
}

TEST_CASE("the table under objects that people labelled (mOSD), when normals weigh little") {
  for (const std::string name : {"learn0", "learn36"}) {
    const auto scan = velum::test::tabletop(name);
    if (!scan) {
      WARN("skipped: VELUM_SHARED has no mOSD");
      return;
    }
    const Outcome outcome = Stage("segmentation.pcl_ransac")
                                .set("epsilon", "10 mm")
                                .set("normal_weight", "0.02")
                                .set("shapes", "1")
                                .run(velum::test::joined_labels(*scan, 1, 9, 1));
    CHECK(velum::test::score(outcome.get<Clusters>(), 1).iou() > 0.95);
  }
}

TEST_CASE("airborne ground that people labelled (ISPRS) is met as the README says") {
  Stage made("segmentation.pcl_ransac");
  made.set("epsilon", "2 m").set("shapes", "1");
  std::string faults;
  if (!velum::test::holds_on_terrain(
          made, {{"samp11", 0.454, 0.726}, {"samp22", 0.825, 0.920}, {"samp53", 0.278, 0.979}},
          faults))
    WARN("skipped: VELUM_SHARED has no ISPRS scans");
  INFO(faults);
  CHECK(faults.empty());
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("segmentation.pcl_ransac")) FAIL_CHECK(fault);
}
