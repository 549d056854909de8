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
  return Stage("resampling.cgal_wlop");
}

}  // namespace

TEST_CASE("the wanted share of points is left, on the surface") {
  const auto out = stage().run(bent_sheet(2.0, 0.004));
  CHECK(out.cloud().size() == 336);
  CHECK(out.measure("share") == Approx(0.2).epsilon(0.01));
  CHECK(sheet_error(out.cloud(), 2.0, 0.15) < 0.6 * 0.004);
}

TEST_CASE("outliers do not draw the surface") {
  Points points(3, 41 * 41 + 20);
  points.leftCols(41 * 41) = bent_sheet(1e9, 0.002).positions();
  velum::Random random(3);
  for (Index i = 0; i < 20; ++i)
    points.col(41 * 41 + i) =
        Eigen::Vector3d(0.2 + 0.4 * random.uniform(), 0.2 + 0.4 * random.uniform(), 0.05)
            .cast<float>();
  const Cloud out = stage().set("radius", "100 mm").run(Cloud(points)).cloud();
  CHECK(sheet_error(out, 1e9, 0.15) < 0.003);
}

TEST_CASE("points are spread more evenly than by chance") {
  const Cloud in = bent_sheet(1e9, 0.004);
  const Cloud out = stage().run(in).cloud();
  std::vector<velum::Neighbour> found;
  double least = 1.0;
  for (Index i = 0; i < out.size(); ++i) {
    out.neighbours().nearest(out.positions().col(i), 2, found);
    least = std::min(least, std::sqrt(static_cast<double>(found[1].distance2)));
  }
  // One point for 0.64 m² / 336 = 44 mm squared.
  CHECK(least > 0.01);
}

TEST_CASE("a share so small that no point would be left gives one") {
  CHECK(stage().set("share", "1e-6").run(bent_sheet(2.0, 0.0)).cloud().size() == 1);
}

TEST_CASE("new points have the columns of the nearest old ones") {
  Cloud in = bent_sheet(2.0, 0.004);
  Eigen::VectorXi label(in.size());
  for (Index i = 0; i < in.size(); ++i) label[i] = in.positions()(0, i) < 0.4F ? 1 : 2;
  const Cloud out = stage().run(in.with("label", velum::Column(label))).cloud();
  int wrong = 0;
  for (Index i = 0; i < out.size(); ++i)
    if (std::abs(out.positions()(0, i) - 0.4F) > 0.03F)
      wrong += (out.labels()[i] == 1) != (out.positions()(0, i) < 0.4F) ? 1 : 0;
  CHECK(wrong == 0);
  CHECK(out.sensors().size() == 1);
}

TEST_CASE("far from the origin it is the same") {
  const Cloud in = bent_sheet(2.0, 0.004);
  const Cloud far =
      stage().run(Cloud(Points(in.positions()), Eigen::Vector3d(4e5, 5e6, 0))).cloud();
  CHECK(far.positions() == stage().run(in).cloud().positions());
}

TEST_CASE("two points are returned as they are") {
  const Cloud in(Points(Points::Random(3, 2)));
  const auto out = stage().run(in);
  CHECK(out.cloud().positions() == in.positions());
  CHECK(out.warnings.size() == 1);
}

TEST_CASE("shares out of range are refused") {
  CHECK_THROWS_AS(stage().set("share", "0"), velum::Error);
  CHECK_THROWS_AS(stage().set("share", "1.5"), velum::Error);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("resampling.cgal_wlop")) FAIL_CHECK(fault);
}
