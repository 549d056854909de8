// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT

#include <catch2/catch.hpp>
#include <cmath>

#include "shapes/test_segmentation.hpp"

using velum::Cloud;
using velum::Clusters;
using velum::Index;
using velum::Points;
using velum::test::noisy_shapes;
using velum::test::Outcome;
using velum::test::Stage;

namespace {

Stage stage() {
  Stage made("segmentation.pcl_ransac");
  made.set("min_size", "500");
  return made;
}

}  // namespace

TEST_CASE("a flat patch is one cluster, and its row in the table tells it") {
  velum::test::describes_a_patch(stage().set("epsilon", "2 mm"));
}

TEST_CASE("what every segmentation promises") {
  velum::test::keeps_promises_with_normals(stage());
}

TEST_CASE("plane, sphere and cylinder of the scene are found, the cone is not") {
  const auto found = [](const char* model) {
    return stage().set("model", model).set("shapes", "1").run(noisy_shapes());
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
  const Cloud& cloud = noisy_shapes();
  CHECK(stage().set("shapes", "1").run(cloud).measure("clusters") == 1.0);
  const Outcome lower = stage().set("shapes", "2").set("min_size", "50").run(cloud);
  CHECK(lower.measure("clusters") == 2.0);
}

TEST_CASE("the table under objects that people labelled (mOSD), when normals weigh little") {
  Stage made("segmentation.pcl_ransac");
  velum::test::finds_the_tabletop(
      made.set("epsilon", "10 mm").set("normal_weight", "0.02").set("shapes", "1"));
}

TEST_CASE("airborne ground that people labelled (ISPRS) is met as the README says") {
  Stage made("segmentation.pcl_ransac");
  made.set("epsilon", "2 m").set("shapes", "1");
  velum::test::finds_the_ground(
      made, {{"samp11", 0.454, 0.726}, {"samp22", 0.825, 0.920}, {"samp53", 0.278, 0.979}});
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("segmentation.pcl_ransac")) FAIL_CHECK(fault);
}
