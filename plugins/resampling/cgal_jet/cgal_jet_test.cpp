// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <velum/testing.hpp>

#include "smoothing/test_sheet.hpp"

using velum::Cloud;
using velum::Index;
using velum::Points;
using velum::test::bent_sheet;
using velum::test::sheet_error;
using velum::test::Stage;

namespace {

Stage stage() {
  return Stage("resampling.cgal_jet");
}

}  // namespace

TEST_CASE("noise falls inside a curved sheet") {
  const auto out = stage().run(bent_sheet(2.0, 0.004));
  CHECK(out.cloud().size() == 41 * 41);
  CHECK(sheet_error(out.cloud(), 2.0, 0.1) < 0.6 * 0.004);
  CHECK(out.measure("moved_rms") > 0.002);
  CHECK(out.measure("unmoved") == 0.0);
}

TEST_CASE("a surface of the jet's degree is met") {
  CHECK(sheet_error(stage().run(bent_sheet(2.0, 0.0)).cloud(), 2.0, 0.0) < 1e-4);
}

TEST_CASE("more neighbours smooth more") {
  const Cloud in = bent_sheet(2.0, 0.004);
  const double few = sheet_error(stage().set("neighbours", "12").run(in).cloud(), 2.0, 0.15);
  const double many = sheet_error(stage().set("neighbours", "80").run(in).cloud(), 2.0, 0.15);
  CHECK(many < 0.6 * few);
}

TEST_CASE("a plane flattens what a jet keeps") {
  const Cloud in = bent_sheet(0.4, 0.0);
  const auto error = [&](const char* degree) {
    return sheet_error(stage().set("neighbours", "60").set("degree", degree).run(in).cloud(), 0.4,
                       0.15);
  };
  CHECK(error("1") > 5.0 * error("2"));
}

TEST_CASE("a degree needs its number of neighbours") {
  CHECK_THROWS_WITH(stage().set("degree", "3").set("neighbours", "8").run(bent_sheet(2.0, 0.0)),
                    Catch::Contains("at least 10 neighbours"));
}

TEST_CASE("columns, origin and sensors stay") {
  Cloud in = bent_sheet(2.0, 0.004);
  in = in.with("label", velum::Column(Eigen::VectorXi::Constant(in.size(), 5).eval()));
  const Cloud far = Cloud(Points(in.positions()), Eigen::Vector3d(4e5, 5e6, 10.0))
                        .with_sensors(in.sensors())
                        .with("label", in.column("label"));
  const Cloud out = stage().run(far).cloud();
  CHECK(out.origin() == far.origin());
  CHECK(out.sensors().size() == 1);
  CHECK(out.labels()[40] == 5);
}

TEST_CASE("a few points are left alone") {
  const Cloud in(Points(Points::Random(3, 5)));
  const auto out = stage().run(in);
  CHECK(out.cloud().positions() == in.positions());
  CHECK(out.warnings.size() == 1);
}

TEST_CASE("points that coincide do not stop it") {
  Points points(3, 60);
  points.leftCols(30) = Points::Random(3, 30);
  points.rightCols(30) = points.leftCols(30);
  CHECK(stage().run(Cloud(points)).cloud().positions().allFinite());
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("resampling.cgal_jet")) FAIL_CHECK(fault);
}
