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
  Stage made("segmentation.cgal_efficient_ransac");
  made.set("min_size", "500");
  return made;
}

}  // namespace

TEST_CASE("a flat patch is one cluster, and its row in the table tells it") {
  velum::test::describes_a_patch(stage().set("epsilon", "2 mm").set("gap", "0.05"));
}

TEST_CASE("what every segmentation promises") {
  velum::test::keeps_promises_with_normals(stage());
}

TEST_CASE("the scene's shapes are found with their kinds and sizes") {
  const Outcome outcome = stage().run(noisy_shapes());
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
  const Outcome outcome = stage().set("model", "plane").run(noisy_shapes());
  const auto& kinds = outcome.get<Clusters>().kinds;
  REQUIRE(kinds.size() >= 1);
  for (std::size_t r = 0; r < kinds.size(); ++r)
    CHECK(kinds.at(r, "model") == velum::Cell(std::string("plane")));
  CHECK(kinds.number(0, "point_z") == Approx(0.0).margin(0.002));
}

TEST_CASE("the same seed gives the same result") {
  velum::test::repeats_with_its_seed(stage());
}

TEST_CASE("airborne ground that people labelled (ISPRS) is met as the README says") {
  Stage made("segmentation.cgal_efficient_ransac");
  made.set("model", "plane").set("epsilon", "2 m");
  velum::test::finds_the_ground(
      made, {{"samp11", 0.252, 0.823}, {"samp22", 0.836, 0.891}, {"samp53", 0.339, 0.974}});
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("segmentation.cgal_efficient_ransac"))
    FAIL_CHECK(fault);
}
