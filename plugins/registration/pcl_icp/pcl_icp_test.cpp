// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <velum/testing.hpp>

#include "registration/test_borrowed.hpp"

using namespace velum::registration::test;
using velum::Cloud;
using velum::test::Stage;

namespace {

const LibraryStage kLibrary{
    "registration.pcl_icp",
    {{"metric", "point_to_plane"}, {"relative_change", "1e-6"}, {"iterations", "60"}},
    2e-3};

}  // namespace

TEST_CASE("PCL's ICP finds a known motion") {
  finds_a_known_motion(kLibrary);
}

TEST_CASE("PCL's ICP starts where it is told, far from zero") {
  starts_where_it_is_told(kLibrary);
}

TEST_CASE("PCL's ICP does not come back from 120 degrees, and the measures show it") {
  far_start_shows(kLibrary);
}

TEST_CASE("PCL's ICP refuses clouds of too few points") {
  refuses_too_few(kLibrary);
}

TEST_CASE("PCL's ICP refuses clouds that are too far apart") {
  refuses_clouds_apart(kLibrary);
}

TEST_CASE("PCL's ICP says when it did not settle") {
  says_when_it_did_not_settle(kLibrary);
}

TEST_CASE("PCL's ICP ends when interrupted") {
  ends_when_interrupted(kLibrary);
}

TEST_CASE("PCL's ICP keeps to the promises of every stage") {
  keeps_the_promises(kLibrary);
}

TEST_CASE("PCL's ICP by points and by the symmetric objective finds the same motion") {
  for (const char* metric : {"point_to_point", "symmetric"}) {
    LibraryStage library = kLibrary;
    library.settings["metric"] = metric;
    library.accuracy = 40e-3;  // points alone are held no better than their spacing
    INFO(metric);
    finds_a_known_motion(library);
    keeps_the_promises(library);
  }
}

TEST_CASE("PCL's ICP by planes needs normals of both clouds") {
  const Cloud target = bumpy(500, 1);
  CHECK_THROWS_WITH(kLibrary.stage().run(target.without("normals"), target),
                    Catch::Contains("normals"));
  CHECK_THROWS_WITH(kLibrary.stage().run(target, target.without("normals")),
                    Catch::Contains("normals"));
}

TEST_CASE("pairs that are not mutual are left out of PCL's ICP") {
  const Cloud whole = bumpy(3000, 1);
  std::vector<std::int32_t> lower;
  for (velum::Index i = 0; i < whole.size(); ++i)
    if (whole.positions()(2, i) < 0.15F) lower.push_back(static_cast<std::int32_t>(i));
  const Cloud target = whole.select(lower);
  const auto start = as_transform(turned(3.0, {0.02, 0.0, 0.02}));
  const auto miss = [&](const char* pairs) {
    return found(Stage("registration.pcl_icp")
                     .set("correspondences", pairs)
                     .set("relative_change", "1e-7")
                     .set("iterations", "60")
                     .run(whole, target, start))
        .translation()
        .norm();
  };
  CHECK(miss("reciprocal") < 0.2 * miss("nearest"));
}
