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
  Stage made("segmentation.pcl_region_growing");
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
  const Outcome outcome = stage().run(cloud);
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

TEST_CASE("the scene's shapes are regions, as in the thesis (table 3.27)") {
  const Outcome outcome = stage().run(scene());
  REQUIRE(outcome.get<Clusters>().kinds.size() == 4);
  const std::pair<int, double> shares[] = {{1, 0.98}, {2, 0.98}, {3, 0.97}, {4, 0.9}};
  for (const auto& [label, share] : shares) {
    const auto score = velum::test::score(outcome.get<Clusters>(), label);
    CHECK(score.counted() > share);
    CHECK(score.precision() > 0.99);
  }
}

TEST_CASE("a wide angle joins what a narrow one parts") {
  const double narrow = stage().run(scene()).measure("clusters");
  const double wide = stage().set("smoothness", "60 deg").run(scene()).measure("clusters");
  CHECK(wide < narrow);
  CHECK_THROWS_AS(stage().set("max_size", "10").run(scene()), velum::Error);
}

TEST_CASE("more neighbours than points are no more than there are") {
  const Cloud cloud = Stage("features.normals").set("neighbours", "5").run(Cloud(patch(4))).cloud();
  CHECK(stage().set("min_size", "1").set("neighbours", "500").run(cloud).measure("clusters") >=
        1.0);
}

TEST_CASE("the table under objects that people labelled (mOSD)") {
  for (const std::string name : {"learn0", "learn36"}) {
    const auto scan = velum::test::tabletop(name);
    if (!scan) {
      WARN("skipped: VELUM_SHARED has no mOSD");
      return;
    }
    const Outcome outcome = stage().run(velum::test::joined_labels(*scan, 1, 9, 1));
    CHECK(velum::test::score(outcome.get<Clusters>(), 1).iou() > 0.95);
  }
}

TEST_CASE("airborne ground that people labelled (ISPRS) is met as the README says") {
  const Stage made("segmentation.pcl_region_growing");
  std::string faults;
  if (!velum::test::holds_on_terrain(
          made, {{"samp11", 0.202, 0.928}, {"samp22", 0.763, 0.881}, {"samp53", 0.925, 0.976}},
          faults))
    WARN("skipped: VELUM_SHARED has no ISPRS scans");
  INFO(faults);
  CHECK(faults.empty());
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("segmentation.pcl_region_growing"))
    FAIL_CHECK(fault);
}
