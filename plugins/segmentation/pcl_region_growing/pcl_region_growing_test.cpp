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
  Stage made("segmentation.pcl_region_growing");
  made.set("min_size", "500");
  return made;
}

}  // namespace

TEST_CASE("a flat patch is one cluster, and its row in the table tells it") {
  velum::test::describes_a_patch(stage());
}

TEST_CASE("what every segmentation promises") {
  velum::test::keeps_promises_with_normals(stage());
}

TEST_CASE("the scene's shapes are regions, as in the thesis (table 3.27)") {
  const Outcome outcome = stage().run(noisy_shapes());
  REQUIRE(outcome.get<Clusters>().kinds.size() == 4);
  const std::pair<int, double> shares[] = {{1, 0.98}, {2, 0.98}, {3, 0.97}, {4, 0.9}};
  for (const auto& [label, share] : shares) {
    const auto score = velum::test::score(outcome.get<Clusters>(), label);
    CHECK(score.counted() > share);
    CHECK(score.precision() > 0.99);
  }
}

TEST_CASE("a wide angle joins what a narrow one parts") {
  const double narrow = stage().run(noisy_shapes()).measure("clusters");
  const double wide = stage().set("smoothness", "60 deg").run(noisy_shapes()).measure("clusters");
  CHECK(wide < narrow);
  CHECK_THROWS_AS(stage().set("max_size", "10").run(noisy_shapes()), velum::Error);
}

TEST_CASE("more neighbours than points are no more than there are") {
  const Cloud cloud = velum::test::with_normals(Cloud(velum::test::flat_patch(4)), 5);
  CHECK(stage().set("min_size", "1").set("neighbours", "500").run(cloud).measure("clusters") >=
        1.0);
}

TEST_CASE("the table under objects that people labelled (mOSD)") {
  velum::test::finds_the_tabletop(stage());
}

TEST_CASE("airborne ground that people labelled (ISPRS) is met as the README says") {
  const Stage made("segmentation.pcl_region_growing");
  velum::test::finds_the_ground(
      made, {{"samp11", 0.202, 0.928}, {"samp22", 0.763, 0.881}, {"samp53", 0.925, 0.976}});
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("segmentation.pcl_region_growing"))
    FAIL_CHECK(fault);
}
