// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Index;
using velum::Points;
using velum::test::Stage;

namespace {

// Points along x, a metre apart, from `first` on.
Cloud row(Index count, float first = 0.0F, const Eigen::Vector3d& origin = {0, 0, 0}) {
  Points points = Points::Zero(3, count);
  for (Index i = 0; i < count; ++i) points(0, i) = first + static_cast<float>(i);
  return Cloud(std::move(points), origin)
      .with("label",
            velum::Column(Eigen::VectorXi::LinSpaced(count, 0, static_cast<int>(count) - 1).eval()))
      .with_sensors({velum::Sensor{}});
}

Stage stage(const char* radius, const char* keep = "shared") {
  Stage made("filtering.overlap");
  made.set("radius", radius).set("keep", keep);
  return made;
}

}  // namespace

TEST_CASE("what both clouds have stays") {
  // 0 to 9 and 6.2 to 15.2: within half a metre of the other are 6, 7, 8 and 9.
  const auto outcome = stage("0.5").run(row(10), row(10, 6.2F));
  REQUIRE(outcome.cloud().size() == 4);
  for (Index i = 0; i < 4; ++i) CHECK(outcome.cloud().labels()[i] == static_cast<int>(i) + 6);
  CHECK(outcome.measure("overlap") == Approx(0.4));
  CHECK(outcome.measure("removed") == 6.0);
}

TEST_CASE("or what only the first one has") {
  const Cloud out = stage("0.5", "rest").run(row(10), row(10, 6.2F)).cloud();
  REQUIRE(out.size() == 6);
  CHECK(out.labels()[5] == 5);
}

TEST_CASE("shared and rest share the cloud out") {
  for (const char* radius : {"0.1", "0.3", "1.5", "100"}) {
    const Index shared = stage(radius).run(row(10), row(10, 6.2F)).cloud().size();
    CHECK(shared + stage(radius, "rest").run(row(10), row(10, 6.2F)).cloud().size() == 10);
  }
}

TEST_CASE("clouds apart share nothing") {
  CHECK(stage("1").run(row(10), row(10, 50.0F)).cloud().empty());
  CHECK(stage("1", "rest").run(row(10), row(10, 50.0F)).cloud().size() == 10);
}

TEST_CASE("nothing overlaps an empty cloud") {
  const Cloud empty = Cloud(Points(3, 0));
  CHECK(stage("1").run(row(10), empty).cloud().empty());
  CHECK(stage("1", "rest").run(row(10), empty).cloud().size() == 10);
  const auto outcome = stage("1").run(empty, row(10));
  CHECK(outcome.cloud().empty());
  CHECK(outcome.measure("overlap") == 0.0);
}

TEST_CASE("a radius may count the spacing of the first cloud") {
  CHECK(stage("\"0.9 spacing\"").run(row(10), row(10, 9.8F)).measure("overlap") == Approx(0.1));
  CHECK(stage("\"0.7 spacing\"").run(row(10), row(10, 9.8F)).measure("overlap") == 0.0);
}

TEST_CASE("origins may differ") {
  const Eigen::Vector3d far(4e5, 5e6, 0);
  const Cloud shifted = row(10, 6.2F, far);
  CHECK(stage("0.5").run(row(10, 0.0F, far), shifted).cloud().size() == 4);
  // The same places, written about another origin.
  const Cloud rewritten = shifted.with_origin(far + Eigen::Vector3d(100, 0, 0));
  CHECK(stage("0.5").run(row(10, 0.0F, far), rewritten).cloud().size() == 4);
}

TEST_CASE("columns and sensors stay") {
  const Cloud out = stage("0.5").run(row(10), row(10, 6.2F)).cloud();
  CHECK(out.has("label"));
  CHECK(out.sensors().size() == 1);
}

TEST_CASE("no radius is refused") {
  CHECK_THROWS_AS(stage("0"), velum::Error);
  CHECK_THROWS_AS(stage("-1"), velum::Error);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("filtering.overlap")) FAIL_CHECK(fault);
}
