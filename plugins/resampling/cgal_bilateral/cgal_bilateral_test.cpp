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
  return Stage("resampling.cgal_bilateral");
}

Cloud with_normals(const Cloud& cloud) {
  return Stage("features.normals").set("neighbours", "20").run(cloud).cloud();
}

// A roof: two faces at 45° to the level that meet at x = 0.4, with noise along z.
Cloud roof(double noise) {
  velum::Random random(5);
  Points points = bent_sheet(1e9, 0.0).positions();
  Points normals(3, points.cols());
  for (Index i = 0; i < points.cols(); ++i) {
    const double x = points(0, i);
    points(2, i) = static_cast<float>(-std::abs(x - 0.4) + noise * random.gaussian());
    const double side = x < 0.4 ? -1.0 : 1.0;
    normals.col(i) = Eigen::Vector3d(side, 0.0, 1.0).normalized().cast<float>();
  }
  return Cloud(std::move(points)).with("normals", velum::Column(normals));
}

double roof_error(const Cloud& cloud, double near, double far) {
  double squares = 0.0, count = 0.0;
  for (Index i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = cloud.positions().col(i).cast<double>();
    const double away = std::abs(p.x() - 0.4);
    if (away < near || away > far || p.y() < 0.1 || p.y() > 0.7) continue;
    squares += std::pow((p.z() + away) / std::sqrt(2.0), 2);
    count += 1.0;
  }
  return std::sqrt(squares / count);
}

}  // namespace

TEST_CASE("noise falls inside a curved sheet") {
  const auto out = stage().run(with_normals(bent_sheet(2.0, 0.004)));
  CHECK(out.cloud().size() == 41 * 41);
  CHECK(sheet_error(out.cloud(), 2.0, 0.1) < 0.8 * 0.004);
  CHECK(out.measure("moved_rms") > 0.001);
}

TEST_CASE("more rounds smooth a plane more, and flatten a bent sheet") {
  const auto error = [](const Cloud& cloud, double bend, const char* rounds) {
    return sheet_error(stage().set("iterations", rounds).run(with_normals(cloud)).cloud(), bend,
                       0.1);
  };
  CHECK(error(bent_sheet(1e9, 0.004), 1e9, "4") < error(bent_sheet(1e9, 0.004), 1e9, "1"));
  CHECK(error(bent_sheet(2.0, 0.0), 2.0, "4") > 2.0 * error(bent_sheet(2.0, 0.0), 2.0, "1"));
}

TEST_CASE("a crease stays, where a jet rounds it off") {
  const Cloud sharp = stage().run(roof(0.0)).cloud();
  const Cloud rounded = Stage("resampling.cgal_jet").set("neighbours", "48").run(roof(0.0)).cloud();
  CHECK(roof_error(sharp, 0.0, 0.05) < 0.3 * roof_error(rounded, 0.0, 0.05));
}

TEST_CASE("noise on the faces falls") {
  const double before = roof_error(roof(0.003), 0.1, 0.3);
  CHECK(roof_error(stage().run(roof(0.003)).cloud(), 0.1, 0.3) < 0.8 * before);
}

TEST_CASE("normals stay of unit length") {
  const Cloud out = stage().set("iterations", "2").run(roof(0.003)).cloud();
  for (Index i = 0; i < out.size(); ++i) REQUIRE(out.normals().col(i).norm() == Approx(1.0F));
}

TEST_CASE("normals are needed, of unit length") {
  CHECK_THROWS_AS(stage().run(bent_sheet(2.0, 0.0)), velum::Error);
  const Points zero = Points::Zero(3, 41 * 41);
  CHECK_THROWS_WITH(stage().run(bent_sheet(2.0, 0.0).with("normals", velum::Column(zero))),
                    Catch::Contains("not of unit length"));
}

TEST_CASE("columns, origin and sensors stay") {
  const Cloud base = with_normals(bent_sheet(2.0, 0.004));
  const Cloud in =
      base.with("label", velum::Column(Eigen::VectorXi::Constant(base.size(), 5).eval()))
          .with_origin(Eigen::Vector3d(1.0, 2.0, 3.0));
  const Cloud out = stage().run(in).cloud();
  CHECK(out.origin() == in.origin());
  CHECK(out.sensors().size() == 1);
  CHECK(out.labels()[40] == 5);
}

TEST_CASE("a wide angle smooths across the crease") {
  const double narrow = roof_error(stage().run(roof(0.0)).cloud(), 0.0, 0.05);
  const double wide = roof_error(
      stage().set("sharpness", "85 deg").set("iterations", "3").run(roof(0.0)).cloud(), 0.0, 0.05);
  CHECK(wide > narrow);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("resampling.cgal_bilateral")) FAIL_CHECK(fault);
}
