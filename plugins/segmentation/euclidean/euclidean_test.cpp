// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT

#include <catch2/catch.hpp>
#include <cmath>

#include "shapes/test_segmentation.hpp"

using velum::Cloud;
using velum::Clusters;
using velum::Index;
using velum::Points;
using velum::test::Outcome;
using velum::test::Stage;

namespace {

// A ball of `count` points about a centre.
Points ball(Index count, const Eigen::Vector3f& centre, std::uint64_t seed) {
  velum::Random random(seed);
  Points points(3, count);
  for (Index i = 0; i < count; ++i) {
    const Eigen::Vector3d d(random.gaussian(), random.gaussian(), random.gaussian());
    points.col(i) = centre + 0.5F * d.normalized().cast<float>();
  }
  return points;
}

Cloud join(const std::vector<Points>& parts) {
  return velum::merge(std::vector<Cloud>(parts.begin(), parts.end()));
}

// Three balls of 600, 900 and 300 points, two metres apart.
Cloud balls() {
  return join({ball(600, {0, 0, 0}, 1), ball(900, {2, 0, 0}, 2), ball(300, {0, 2, 0}, 3)});
}

Stage stage(const char* distance) {
  Stage made("segmentation.euclidean");
  made.set("distance", distance);
  return made;
}

// The same by a search through all pairs.
Eigen::VectorXi by_hand(const Cloud& cloud, double distance) {
  Eigen::VectorXi group = Eigen::VectorXi::LinSpaced(cloud.size(), 0, int(cloud.size()) - 1);
  for (Index i = 0; i < cloud.size(); ++i)
    for (Index j = 0; j < i; ++j) {
      const Eigen::Vector3d a = cloud.positions().col(i).cast<double>();
      const Eigen::Vector3d b = cloud.positions().col(j).cast<double>();
      if ((a - b).squaredNorm() > distance * distance || group[i] == group[j]) continue;
      const int from = group[i];
      const int to = group[j];
      for (int& one : group)
        if (one == from) one = to;
    }
  return group;
}

}  // namespace

TEST_CASE("what every segmentation promises") {
  velum::test::keeps_promises(stage("4 spacing"), "100000");
}

TEST_CASE("bodies that stand apart are told apart, the largest first (figure 3.24, left)") {
  const Outcome outcome = stage("0.2").run(balls());
  const auto& found = outcome.get<Clusters>();
  REQUIRE(found.kinds.size() == 3);
  CHECK(found.kinds.number(0, "points") == 900.0);
  CHECK(found.kinds.number(1, "points") == 600.0);
  CHECK(found.kinds.number(2, "points") == 300.0);
  CHECK(found.label()[0] == 1);
  CHECK(found.label()[700] == 0);
  CHECK(found.kinds.number(0, "point_x") == Approx(2.0).margin(0.05));
  CHECK(found.kinds.number(0, "length") == Approx(1.0).epsilon(0.1));
  CHECK(found.kinds.at(0, "model") == velum::Cell(std::string("region")));
}

TEST_CASE("on a common plane they are one (figure 3.24, right)") {
  const Outcome outcome = stage("4 spacing").run(velum::test::shapes_scene("4 mm", "1 deg"));
  CHECK(outcome.get<Clusters>().kinds.size() == 1);
  CHECK(outcome.measure("assigned") > 0.99);
}

TEST_CASE("clusters are exactly those of all pairs") {
  velum::Random random(9);
  Points points(3, 700);
  for (float& x : points.reshaped()) x = static_cast<float>(random.uniform());
  const Cloud cloud(points);
  for (const double distance : {0.05, 0.08, 0.1, 0.12}) {
    const Outcome outcome =
        Stage("segmentation.euclidean").set("distance", distance).set("min_size", "1").run(cloud);
    const Eigen::VectorXi expected = by_hand(cloud, distance);
    const auto label = outcome.get<Clusters>().label();
    int wrong = 0;
    for (Index i = 0; i < cloud.size(); ++i)
      for (Index j = 0; j < i; ++j) wrong += (label[i] == label[j]) != (expected[i] == expected[j]);
    CHECK(wrong == 0);
  }
}

TEST_CASE("points exactly the distance apart are together, a little farther they are not") {
  Points points(3, 3);
  points << 0, 1, 2.25F, 0, 0, 0, 0, 0, 0;
  const Outcome outcome = stage("1").set("min_size", "1").run(Cloud(points));
  CHECK(outcome.get<Clusters>().label() == Eigen::Vector3i(0, 0, 1));
  CHECK(stage("1.25").set("min_size", "1").run(Cloud(points)).measure("clusters") == 1.0);
}

TEST_CASE("sizes out of bounds are refused, with a warning when nothing is left") {
  const Outcome outcome = stage("0.2").set("min_size", "500").set("max_size", "800").run(balls());
  REQUIRE(outcome.get<Clusters>().kinds.size() == 1);
  CHECK(outcome.get<Clusters>().kinds.number(0, "points") == 600.0);
  CHECK(outcome.measure("refused") == 2.0);
  const Outcome none = stage("0.2").set("min_size", "5000").run(balls());
  REQUIRE(none.warnings.size() == 1);
  CHECK(none.warnings.front().find("900") != std::string::npos);
  CHECK_THROWS_AS(stage("0.2").set("min_size", "9").set("max_size", "5").run(balls()),
                  velum::Error);
}

TEST_CASE("a radius that is nothing beside the extent is refused") {
  CHECK_THROWS_AS(stage("1e-12").run(balls()), velum::Error);
}

TEST_CASE("a distance over the whole cloud makes one cluster, at no cost") {
  const Outcome outcome = stage("1000 m").run(balls());
  CHECK(outcome.measure("clusters") == 1.0);
  CHECK(outcome.measure("largest") == 1800.0);
}

TEST_CASE("far from the origin of the axes nothing changes") {
  const Cloud here = balls();
  const Cloud far(Points(here.positions()), Eigen::Vector3d(5.4e6, 1e7, 300.0));
  const Outcome a = stage("0.2").run(here);
  const Outcome b = stage("0.2").run(far);
  CHECK(a.get<Clusters>().label() == b.get<Clusters>().label());
  CHECK(b.get<Clusters>().kinds.number(0, "point_y") == Approx(1e7));
}

TEST_CASE("objects on a table join it (mOSD)") {
  const auto scan = velum::test::tabletop("learn0");
  if (!scan) {
    WARN("skipped: VELUM_SHARED has no mOSD");
    return;
  }
  const Outcome outcome = stage("4 spacing").run(velum::test::joined_labels(*scan, 1, 9, 1));
  const auto table = velum::test::score(outcome.get<Clusters>(), 1);
  CHECK(table.recall() > 0.98);
  CHECK(table.precision() < 0.9);
}

TEST_CASE("airborne ground that people labelled (ISPRS) is met as the README says") {
  const Stage made("segmentation.euclidean");
  velum::test::finds_the_ground(
      made, {{"samp11", 0.996, 0.595}, {"samp22", 0.949, 0.834}, {"samp53", 0.999, 0.960}});
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("segmentation.euclidean")) FAIL_CHECK(fault);
}
