// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Clusters;
using velum::Index;
using velum::Points;
using velum::test::Stage;

namespace {

// Ten points along x: 0 to 2 are cluster 1, 3 is in none, 4 to 8 are cluster 0, 9 is cluster 2.
Clusters three(const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  Points points = Points::Zero(3, 10);
  for (Index i = 0; i < 10; ++i) points(0, i) = static_cast<float>(i);
  Eigen::VectorXi labels(10);
  labels << 1, 1, 1, -1, 0, 0, 0, 0, 0, 2;
  velum::Table kinds({{"cluster", ""}, {"points", ""}});
  for (const auto& [number, count] : {std::pair{0, 5}, {1, 3}, {2, 1}})
    kinds.add({std::int64_t{number}, std::int64_t{count}});
  const Cloud cloud = Cloud(std::move(points), origin)
                          .with("label", velum::Column(Eigen::VectorXi::LinSpaced(10, 0, 9).eval()))
                          .with_sensors({velum::Sensor{}});
  return {cloud, velum::Column(labels), kinds};
}

Clusters none() {
  return {Cloud(Points(Points::Zero(3, 4))), velum::Column(Eigen::VectorXi::Constant(4, -1).eval()),
          velum::Table({{"cluster", ""}, {"points", ""}})};
}

Stage stage(const char* which) {
  Stage made("filtering.select_cluster");
  made.set("which", which);
  return made;
}

}  // namespace

TEST_CASE("the largest cluster is the default") {
  const auto outcome = Stage("filtering.select_cluster").run(three());
  CHECK(outcome.cloud().size() == 5);
  CHECK(outcome.measure("cluster") == 0.0);
  CHECK(outcome.measure("points") == 5.0);
}

TEST_CASE("a cluster is found by its number") {
  const Cloud cloud = stage("index").set("index", "1").run(three()).cloud();
  REQUIRE(cloud.size() == 3);
  CHECK(cloud.positions()(0, 2) == 2.0F);
}

TEST_CASE("a cluster is found by a place on it") {
  CHECK(stage("containing").set("point", "[8.9, 0.2, 0]").run(three()).measure("cluster") == 2.0);
  // The point nearest to this place is in no cluster; cluster 1 comes next.
  CHECK(stage("containing").set("point", "[2.6, 0, 0]").run(three()).measure("cluster") == 1.0);
}

TEST_CASE("the place is absolute") {
  const Clusters far = three({4e5, 5e6, 0});
  CHECK(stage("containing").set("point", "[400001, 5000000, 0]").run(far).measure("cluster") ==
        1.0);
}

TEST_CASE("columns, order and sensors stay") {
  const Cloud cloud = Stage("filtering.select_cluster").run(three()).cloud();
  CHECK(cloud.sensors().size() == 1);
  for (Index i = 0; i < 5; ++i) CHECK(cloud.labels()[i] == static_cast<int>(i) + 4);
}

TEST_CASE("a number that no cluster has is an error that says how many there are") {
  try {
    stage("index").set("index", "7").run(three());
    FAIL("no error");
  } catch (const velum::Error& error) {
    CHECK(error.fault() == velum::Fault::stage);
    CHECK(std::string(error.what()).find("there are 3") != std::string::npos);
  }
}

TEST_CASE("index and containing need their parameter") {
  CHECK_THROWS_AS(stage("index").run(three()), velum::Error);
  CHECK_THROWS_AS(stage("containing").run(three()), velum::Error);
}

TEST_CASE("of no clusters the largest is empty") {
  CHECK(Stage("filtering.select_cluster").run(none()).cloud().empty());
  CHECK(stage("containing").set("point", "[0, 0, 0]").run(none()).cloud().empty());
  CHECK_THROWS_AS(stage("index").set("index", "0").run(none()), velum::Error);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("filtering.select_cluster")) FAIL_CHECK(fault);
}
