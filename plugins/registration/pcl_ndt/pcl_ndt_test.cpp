// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <velum/testing.hpp>

#include "registration/test_borrowed.hpp"

using namespace velum::registration::test;
using velum::Cloud;
using velum::test::Stage;

namespace {

const LibraryStage kLibrary{"registration.pcl_ndt",
                            {{"cell", "0.2 m"}, {"step", "0.05 m"}, {"still_shift", "1e-5 m"}},
                            6e-3};

}  // namespace

TEST_CASE("PCL's NDT finds a known motion") {
  finds_a_known_motion(kLibrary);
}

TEST_CASE("PCL's NDT starts where it is told, far from zero") {
  starts_where_it_is_told(kLibrary);
}

TEST_CASE("PCL's NDT does not come back from 120 degrees, and the measures show it") {
  far_start_shows(kLibrary);
}

TEST_CASE("PCL's NDT refuses clouds of too few points") {
  refuses_too_few(kLibrary);
}

TEST_CASE("PCL's NDT refuses clouds that are too far apart") {
  refuses_clouds_apart(kLibrary);
}

TEST_CASE("PCL's NDT says when it did not settle") {
  says_when_it_did_not_settle(kLibrary);
}

TEST_CASE("PCL's NDT ends when interrupted") {
  ends_when_interrupted(kLibrary);
}

TEST_CASE("PCL's NDT keeps to the promises of every stage") {
  keeps_the_promises(kLibrary);
}

TEST_CASE("PCL's NDT refuses more cells than PCL can number") {
  CHECK_THROWS_WITH(
      Stage("registration.pcl_ndt").set("cell", "0.1 mm").run(bumpy(500, 1), bumpy(500, 1)),
      Catch::Contains("PCL's NDT can number"));
}
