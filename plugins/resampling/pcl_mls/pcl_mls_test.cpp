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

Stage stage(const char* radius = "80 mm") {
  Stage made("resampling.pcl_mls");
  made.set("radius", radius);
  return made;
}

}  // namespace

TEST_CASE("noise falls inside a curved sheet") {
  const auto out = stage().run(bent_sheet(2.0, 0.004));
  CHECK(sheet_error(out.cloud(), 2.0, 0.1) < 0.35 * 0.004);
  CHECK(out.cloud().size() == 41 * 41);
  CHECK(out.measure("lost") == 0.0);
}

TEST_CASE("a surface of the polynomial's order is met") {
  CHECK(sheet_error(stage().run(bent_sheet(2.0, 0.0)).cloud(), 2.0, 0.1) < 1e-4);
}

TEST_CASE("a plane instead of a polynomial flattens the sheet") {
  const Cloud in = bent_sheet(0.5, 0.0);
  CHECK(sheet_error(stage().set("order", "1").run(in).cloud(), 0.5, 0.1) > 7e-4);
  CHECK(sheet_error(stage().set("order", "2").run(in).cloud(), 0.5, 0.1) < 3e-4);
}

TEST_CASE("a smaller radius smooths less") {
  const Cloud in = bent_sheet(2.0, 0.004);
  const double wide = sheet_error(stage().run(in).cloud(), 2.0, 0.1);
  const double narrow = sheet_error(stage("45 mm").run(in).cloud(), 2.0, 0.1);
  CHECK(narrow > 1.2 * wide);
}

TEST_CASE("normals are the surface's and look at the sensor") {
  const Cloud out = stage().run(bent_sheet(2.0, 0.0)).cloud();
  for (Index i = 0; i < out.size(); ++i) {
    const double x = out.positions()(0, i);
    const Eigen::Vector3d truth = Eigen::Vector3d(-x / 2.0, 0.0, 1.0).normalized();
    REQUIRE(out.normals().col(i).cast<double>().dot(truth) > 0.99);
  }
  CHECK(out.curvature().minCoeff() >= 0.0F);
  CHECK(out.curvature().maxCoeff() <= 1.0F / 3.0F);
}

TEST_CASE("points without neighbours are lost, and it is said") {
  const Cloud far(Points(Points::Constant(3, 1, 9.0F)));
  const Cloud in =
      velum::merge(std::vector<Cloud>{bent_sheet(2.0, 0.0), far.with_sensors({velum::Sensor{}})});
  const auto out = stage().run(in);
  CHECK(out.cloud().size() == in.size() - 1);
  CHECK(out.measure("lost") == 1.0);
  CHECK(out.warnings.size() == 1);
}

TEST_CASE("results come in the order of the points, whatever the threads") {
  Cloud in = bent_sheet(2.0, 0.004);
  in = in.with(
      "label",
      velum::Column(
          Eigen::VectorXi::LinSpaced(in.size(), 0, static_cast<int>(in.size()) - 1).eval()));
  const Cloud one = stage().threads(1).run(in).cloud();
  const Cloud two = stage().threads(2).run(in).cloud();
  CHECK(velum::hash_of(one) == velum::hash_of(two));
  for (Index i = 0; i < in.size(); ++i) REQUIRE(one.labels()[i] == i);
}

TEST_CASE("both projections meet the surface") {
  const Cloud in = bent_sheet(2.0, 0.0);
  for (const char* projection : {"simple", "orthogonal"})
    CHECK(sheet_error(stage().set("projection", projection).run(in).cloud(), 2.0, 0.1) < 2e-4);
}

TEST_CASE("a missing radius is refused") {
  CHECK_THROWS_AS(Stage("resampling.pcl_mls").run(bent_sheet(2.0, 0.0)), velum::Error);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("resampling.pcl_mls", {{"radius", "0.3"}}))
    FAIL_CHECK(fault);
}
