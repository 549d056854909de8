// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Index;
using velum::Points;
using velum::test::Stage;

namespace {

// A row of points 1 m apart, then one alone 10 m further on.
Cloud row_and_one(Index count) {
  Points points = Points::Zero(3, count + 1);
  for (Index i = 0; i < count; ++i) points(0, i) = static_cast<float>(i);
  points(0, count) = static_cast<float>(count) + 9.0F;
  return Cloud(std::move(points));
}

Stage stage(const char* radius, const char* least) {
  Stage made("filtering.radius_outliers");
  made.set("radius", radius).set("min_neighbours", least);
  return made;
}

}  // namespace

TEST_CASE("a point alone goes, the row stays") {
  const auto outcome = stage("1.5", "1").run(row_and_one(10));
  CHECK(outcome.cloud().size() == 10);
  CHECK(outcome.measure("removed") == 1.0);
  CHECK(outcome.measure("kept") == 10.0);
}

TEST_CASE("the point itself does not count") {
  // The ends of the row have one other point within 1.5 m.
  CHECK(stage("1.5", "2").run(row_and_one(10)).cloud().size() == 8);
}

TEST_CASE("a neighbour at exactly the radius counts") {
  CHECK(stage("1", "2").run(row_and_one(10)).cloud().size() == 8);
  CHECK(stage("0.999", "1").run(row_and_one(10)).cloud().empty());
}

TEST_CASE("copies of a point are neighbours of it") {
  const Cloud cloud(Points(Points::Ones(3, 6)));
  CHECK(stage("0.001", "5").run(cloud).cloud().size() == 6);
  CHECK(stage("0.001", "6").run(cloud).cloud().empty());
}

TEST_CASE("columns and order stay with the points") {
  Eigen::VectorXi label(11);
  for (Index i = 0; i < 11; ++i) label[i] = static_cast<int>(i);
  const Cloud out =
      stage("1.5", "2").run(row_and_one(10).with("label", velum::Column(label))).cloud();
  REQUIRE(out.size() == 8);
  for (Index i = 0; i < 8; ++i) CHECK(out.labels()[i] == static_cast<int>(i) + 1);
}

TEST_CASE("the radius may be given in spacings") {
  CHECK(stage("1.5 spacing", "1").run(row_and_one(100)).cloud().size() == 100);
}

TEST_CASE("a cloud that is all ordinary is handed on as it is") {
  const Cloud in(Points(Points::Random(3, 500)));
  const Cloud out = stage("10", "1").run(in).cloud();
  CHECK(out.position_column().same_storage(in.position_column()));
}

TEST_CASE("a radius of zero, and none at all, are refused") {
  CHECK_THROWS_AS(Stage("filtering.radius_outliers").set("radius", "0"), velum::Error);
  CHECK_THROWS_AS(Stage("filtering.radius_outliers").run(row_and_one(3)), velum::Error);
}

TEST_CASE("conformance") {
  for (const auto& fault :
       velum::test::conformance("filtering.radius_outliers", {{"radius", "0.1"}}))
    FAIL_CHECK(fault);
}
