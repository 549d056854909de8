// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Index;
using velum::Points;
using velum::Table;
using velum::test::Stage;

namespace {

// Ten points 1 m apart, of beams 0 to 9 of line 3.
Cloud row() {
  Points points = Points::Zero(3, 10);
  points.row(0) = Eigen::RowVectorXf::LinSpaced(10, 0.0F, 9.0F);
  return Cloud(std::move(points))
      .with("beam", velum::Column(Eigen::VectorXi::LinSpaced(10, 0, 9).eval()))
      .with("line", velum::Column(Eigen::VectorXi::Constant(10, 3).eval()));
}

// Point i moved up by i mm.
Cloud moved() {
  Points points = row().positions();
  points.row(2) = Eigen::RowVectorXf::LinSpaced(10, 0.0F, 0.009F);
  return row().with_positions(std::move(points));
}

Stage stage() {
  return Stage("analysis.displacement");
}

}  // namespace

TEST_CASE("shares of good, fair and bad") {
  auto made = stage().set("good", "3.5 mm").set("bad", "7.5 mm");
  const auto out = made.run(moved(), row());
  CHECK(out.measure("good") == Approx(0.4));
  CHECK(out.measure("fair") == Approx(0.4));
  CHECK(out.measure("bad") == Approx(0.2));
  CHECK(out.measure("max") == Approx(0.009));
  CHECK(out.measure("mean") == Approx(0.0045));
  CHECK(out.measure("median") == Approx(0.004));
}

TEST_CASE("the thesis's limits are the defaults") {
  const auto out = stage().run(moved(), row());
  CHECK(out.measure("good") + out.measure("fair") + out.measure("bad") == Approx(1.0));
  for (const auto& parameter : stage().info().parameters) {
    if (parameter.name == "good")
      CHECK(std::get<velum::Length>(parameter.initial.value) == velum::Length(0.004));
    if (parameter.name == "bad")
      CHECK(std::get<velum::Length>(parameter.initial.value) == velum::Length(0.009));
  }
}

TEST_CASE("columns to colour by") {
  const Cloud out = stage().set("good", "3.5 mm").set("bad", "7.5 mm").run(moved(), row()).cloud();
  const auto displacement = out.column("displacement").vector<float>();
  const auto grade = out.column("grade").vector<std::int32_t>();
  for (Index i = 0; i < 10; ++i) {
    CHECK(displacement[i] == Approx(0.001 * static_cast<double>(i)).margin(1e-7));
    CHECK(grade[i] == (i < 4 ? 0 : i < 8 ? 1 : 2));
  }
  CHECK(out.has("beam"));
}

TEST_CASE("the histogram counts every point once, then the grades do") {
  const auto out = stage().set("bins", "3").run(moved(), row());
  const Table& table = out.get<Table>();
  REQUIRE(table.size() == 6);
  double points = 0.0, share = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    points += table.number(i, "points");
    share += table.number(i, "share");
    CHECK(std::get<std::string>(table.at(i, "quantity")) == "displacement");
  }
  CHECK(points == 10.0);
  CHECK(share == Approx(100.0));
  CHECK(table.number(0, "to") == Approx(0.003));
  CHECK(std::get<std::string>(table.at(3, "quantity")) == "good");
  CHECK(table.number(3, "points") + table.number(4, "points") + table.number(5, "points") == 10.0);
}

TEST_CASE("points are found again by their beams where some are gone") {
  const std::vector<std::int32_t> some{9, 2, 5};
  const auto out = stage().run(moved().select(some), row());
  const auto displacement = out.cloud().column("displacement").vector<float>();
  CHECK(displacement[0] == Approx(0.009F));
  CHECK(displacement[1] == Approx(0.002F));
  CHECK(displacement[2] == Approx(0.005F));
}

TEST_CASE("or by place") {
  const std::vector<std::int32_t> some{9, 2, 5};
  const Cloud bare = moved().select(some).without("beam");
  CHECK(stage().run(bare, row()).measure("max") == Approx(0.009));
  CHECK(stage().set("match", "nearest").run(moved(), row()).measure("max") == Approx(0.009));
}

TEST_CASE("another order of the points counts with match = order") {
  std::vector<std::int32_t> turned{1, 0, 2, 3, 4, 5, 6, 7, 8, 9};
  const Cloud other = row().select(turned);
  CHECK(stage().set("match", "order").run(row(), other).measure("max") == Approx(1.0));
  CHECK(stage().set("match", "beam").run(row(), other).measure("max") == 0.0);
}

TEST_CASE("clouds at different origins are compared where they are") {
  const Eigen::Vector3d origin(5.0, -3.0, 2.0);
  CHECK(stage().run(moved().with_origin(origin), row()).measure("max") ==
        Approx(0.009).epsilon(1e-3));
}

TEST_CASE("what cannot be compared is refused") {
  const std::vector<std::int32_t> some{1, 2};
  CHECK_THROWS_WITH(stage().set("match", "order").run(moved().select(some), row()),
                    Catch::Contains("same order"));
  CHECK_THROWS_WITH(stage().set("match", "beam").run(moved().without("line"), row()),
                    Catch::Contains("beam and line"));
  CHECK_THROWS_WITH(stage().run(moved(), row().select(some)), Catch::Contains("could have been"));
  CHECK_THROWS_AS(stage().set("good", "9 mm").set("bad", "4 mm").run(moved(), row()), velum::Error);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("analysis.displacement")) FAIL_CHECK(fault);
}
