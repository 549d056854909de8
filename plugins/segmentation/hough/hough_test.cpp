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
  Stage made("segmentation.hough");
  made.set("model", "any").set("min_size", "500");
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

TEST_CASE("plane and sphere of the scene are found, with and without noise") {
  for (const char* noise : {"0 mm", "4 mm", "20 mm"}) {
    const Outcome outcome = stage().run(velum::test::shapes_scene(noise));
    for (const auto& [label, share] : {std::pair{1, 0.98}, {2, 0.9994}}) {
      const auto score = velum::test::score(outcome.get<Clusters>(), label);
      INFO(noise << ", label " << label << ": " << score.points << " of " << score.truth);
      CHECK(score.counted() >= share);
      CHECK(score.recall() >= share);
      CHECK(score.precision() >= 0.98);
    }
  }
}

TEST_CASE("the sphere alone is found with its centre and radius, with fewer votes too") {
  for (const char* votes : {"20000", "4000"}) {
    const Outcome outcome =
        stage().set("model", "sphere").set("shapes", "1").set("votes", votes).run(scene());
    const auto& kinds = outcome.get<Clusters>().kinds;
    REQUIRE(kinds.size() == 1);
    CHECK(kinds.at(0, "model") == velum::Cell(std::string("sphere")));
    CHECK(kinds.number(0, "radius") == Approx(1.0).epsilon(0.001));
    CHECK(kinds.number(0, "point_x") == Approx(-1.3).margin(0.001));
    CHECK(kinds.number(0, "point_y") == Approx(-1.2).margin(0.001));
    CHECK(kinds.number(0, "point_z") == Approx(1.0).margin(0.001));
  }
}

TEST_CASE("crossing planes are told apart by their votes") {
  Points corner(3, 3 * 400);
  for (Index i = 0; i < 400; ++i) {
    const float a = 0.02F * static_cast<float>(i % 20);
    const float b = 0.02F * static_cast<float>(i / 20);
    corner.col(i) << a, b, 0.0F;
    corner.col(400 + i) << a, -0.01F, b + 0.01F;
    corner.col(800 + i) << -0.01F, a, b + 0.01F;
  }
  const Cloud cloud = Stage("features.normals").set("neighbours", "9").run(Cloud(corner)).cloud();
  const Outcome outcome =
      stage().set("model", "plane").set("min_size", "100").set("epsilon", "4 mm").run(cloud);
  const auto& found = outcome.get<Clusters>();
  REQUIRE(found.kinds.size() == 3);
  for (std::size_t r = 0; r < 3; ++r) {
    CHECK(found.kinds.number(r, "points") > 370.0);
    CHECK(found.kinds.number(r, "rms") < 0.001);
  }
}

TEST_CASE("the same seed gives the same result") {
  const auto labels = [](std::uint64_t seed) {
    return Eigen::VectorXi(stage().seed(seed).run(scene()).get<Clusters>().label());
  };
  CHECK(labels(3) == labels(3));
}

TEST_CASE("the table under objects that people labelled (mOSD)") {
  for (const std::string name : {"learn0", "learn36"}) {
    const auto scan = velum::test::tabletop(name);
    if (!scan) {
      WARN("skipped: VELUM_SHARED has no mOSD");
      return;
    }
    const Outcome outcome = Stage("segmentation.hough")
                                .set("epsilon", "10 mm")
                                .run(velum::test::joined_labels(*scan, 1, 9, 1));
    CHECK(velum::test::score(outcome.get<Clusters>(), 1).iou() > 0.95);
  }
}

TEST_CASE("airborne ground that people labelled (ISPRS) is met as the README says") {
  Stage made("segmentation.hough");
  made.set("epsilon", "2 m");
  std::string faults;
  if (!velum::test::holds_on_terrain(
          made, {{"samp11", 0.165, 0.825}, {"samp22", 0.579, 0.934}, {"samp53", 0.107, 0.980}},
          faults))
    WARN("skipped: VELUM_SHARED has no ISPRS scans");
  INFO(faults);
  CHECK(faults.empty());
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("segmentation.hough")) FAIL_CHECK(fault);
}
