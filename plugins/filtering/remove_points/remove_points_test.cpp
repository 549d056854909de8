// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Index;
using velum::Points;
using velum::test::Stage;

namespace {

// Ten points along x, 1 m apart, labelled 0, 1, 2, 0, 1, 2, ...
Cloud row(const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  Points points = Points::Zero(3, 10);
  Eigen::VectorXi labels(10);
  for (Index i = 0; i < 10; ++i) {
    points(0, i) = static_cast<float>(i);
    labels[i] = static_cast<int>(i % 3);
  }
  return Cloud(std::move(points), origin).with("label", velum::Column(labels));
}

Stage stage() {
  return Stage("filtering.remove_points");
}

}  // namespace

TEST_CASE("a picked place takes the nearest point") {
  const auto outcome = stage().set("points", "[[3.2, 0.1, 0], [8, 0, 0]]").run(row());
  CHECK(outcome.cloud().size() == 8);
  CHECK(outcome.measure("removed") == 2.0);
  for (const float x : outcome.cloud().positions().row(0)) CHECK((x != 3.0F && x != 8.0F));
}

TEST_CASE("with a radius it takes all around it, or none") {
  CHECK(stage().set("points", "[[3, 0, 0]]").set("radius", "1").run(row()).cloud().size() == 7);
  CHECK(stage().set("points", "[[3, 5, 0]]").set("radius", "1").run(row()).cloud().size() == 10);
}

TEST_CASE("places are absolute") {
  const Cloud far = row({4e5, 5e6, 0});
  const Cloud out = stage().set("points", "[[400009, 5000000, 0]]").run(far).cloud();
  REQUIRE(out.size() == 9);
  CHECK(out.positions()(0, 8) == 8.0F);
}

TEST_CASE("points go by number") {
  const Cloud out = stage().set("indices", "[0, 9, 9]").run(row()).cloud();
  REQUIRE(out.size() == 8);
  CHECK(out.positions()(0, 0) == 1.0F);
}

TEST_CASE("points go by label") {
  CHECK(stage().set("labels", "[1, 2]").run(row()).cloud().size() == 4);
}

TEST_CASE("a point that is named twice is removed once") {
  Stage twice = stage().set("labels", "[0]").set("indices", "[0, 3]").set("points", "[[0, 0, 0]]");
  CHECK(twice.run(row()).measure("removed") == 4.0);
}

TEST_CASE("nothing to remove changes nothing") {
  const Cloud in = row();
  const auto outcome = stage().run(in);
  CHECK(outcome.cloud().position_column().same_storage(in.position_column()));
  CHECK(outcome.warnings.size() == 1);
  CHECK_THROWS_AS(stage().set("radius", "1 m").run(in), velum::Error);  // about no points
}

TEST_CASE("a number beyond the cloud, and labels where there are none, are errors") {
  CHECK_THROWS_AS(stage().set("indices", "[10]").run(row()), velum::Error);
  CHECK_THROWS_AS(stage().set("indices", "[-1]"), velum::Error);
  CHECK_THROWS_AS(stage().set("labels", "[1]").run(row().without("label")), velum::Error);
}

TEST_CASE("conformance") {
  for (const auto& fault :
       velum::test::conformance("filtering.remove_points", {{"points", "[[0, 0, 0]]"}}))
    FAIL_CHECK(fault);
}
