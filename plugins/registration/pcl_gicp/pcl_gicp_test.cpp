// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <velum/testing.hpp>

#include "registration/test_borrowed.hpp"

using namespace velum::registration::test;
using velum::Cloud;
using velum::test::Stage;

namespace {

const LibraryStage kLibrary{"registration.pcl_gicp", {{"max_distance", "0.2 m"}}, 6e-3};

}  // namespace

TEST_CASE("PCL's GICP finds a known motion") {
  finds_a_known_motion(kLibrary);
}

TEST_CASE("PCL's GICP starts where it is told, far from zero") {
  starts_where_it_is_told(kLibrary);
}

TEST_CASE("PCL's GICP does not come back from 120 degrees, and the measures show it") {
  far_start_shows(kLibrary);
}

TEST_CASE("PCL's GICP refuses clouds of too few points") {
  refuses_too_few(kLibrary);
}

TEST_CASE("PCL's GICP refuses clouds that are too far apart") {
  refuses_clouds_apart(kLibrary);
}

TEST_CASE("PCL's GICP says when it did not settle") {
  says_when_it_did_not_settle(kLibrary);
}

TEST_CASE("PCL's GICP ends when interrupted") {
  ends_when_interrupted(kLibrary);
}

TEST_CASE("PCL's GICP keeps to the promises of every stage") {
  keeps_the_promises(kLibrary);
}

TEST_CASE("PCL's GICP says how many points its discs need") {
  CHECK_THROWS_WITH(
      Stage("registration.pcl_gicp").set("neighbours", "50").run(bumpy(49, 1), bumpy(100, 1)),
      Catch::Contains("the source has 49 points, PCL's GICP needs at least 50"));
}
