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
  Stage made("segmentation.hough");
  made.set("model", "any").set("min_size", "500");
  return made;
}

}  // namespace

TEST_CASE("a flat patch is one cluster, and its row in the table tells it") {
  velum::test::describes_a_patch(stage().set("epsilon", "2 mm"));
}

TEST_CASE("what every segmentation promises") {
  velum::test::keeps_promises_with_normals(stage());
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
        stage().set("model", "sphere").set("shapes", "1").set("votes", votes).run(noisy_shapes());
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
  const Cloud cloud = velum::test::with_normals(Cloud(corner));
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
  velum::test::repeats_with_its_seed(stage());
}

TEST_CASE("the table under objects that people labelled (mOSD)") {
  velum::test::finds_the_tabletop(Stage("segmentation.hough").set("epsilon", "10 mm"));
}

TEST_CASE("airborne ground that people labelled (ISPRS) is met as the README says") {
  Stage made("segmentation.hough");
  made.set("epsilon", "2 m");
  velum::test::finds_the_ground(
      made, {{"samp11", 0.165, 0.825}, {"samp22", 0.579, 0.934}, {"samp53", 0.107, 0.980}});
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("segmentation.hough")) FAIL_CHECK(fault);
}
