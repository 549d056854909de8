// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "mesh/test_shapes.hpp"

using velum::Cloud;
using velum::Points;
using velum::test::Stage;
using namespace velum::mesh::test;

namespace {

Stage stage(double mu) {
  Stage made("meshing.greedy_projection");
  made.set("mu", mu);
  return made;
}

/// A sixth of a cylinder's circumference, unevenly sampled and with a hand of noise (thesis 3.5.1).
Cloud cylinder() {
  velum::Random random(5);
  Points points(3, 625);
  for (int i = 0; i < 625; ++i) {
    const double angle = random.uniform(0.0, std::numbers::pi / 3.0);
    const double r = 1.0 + 0.002 * random.gaussian();
    const double z = random.uniform();
    points.col(i) = Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), z).cast<float>();
  }
  return with_normals(Cloud(std::move(points)));
}

}  // namespace

TEST_CASE("the thesis's plane of 15 by 15 points with mu 1.5 is a regular mesh") {
  const auto out = stage(1.5).run(with_normals(flat(15)));
  const Quality q = quality(out.mesh());
  CHECK(q.area == Approx(1.0));
  CHECK(q.border == Approx(4.0));
  CHECK(q.holes == 0);
  CHECK(q.manifold == 1);
  CHECK(out.mesh().size() > 370);
}

TEST_CASE("a larger mu makes a less regular mesh (thesis figure 3.61)") {
  const auto ratio = [](double mu) {
    const auto mesh = stage(mu).run(with_normals(flat(15))).mesh();
    return Stage("analysis.mesh_quality").run(mesh).measure("edge_ratio");
  };
  CHECK(ratio(1.5) < 1.42);
  CHECK(ratio(6.0) > ratio(1.5) + 0.1);
}

TEST_CASE("the noisy sixth of a cylinder needs a large mu (thesis 3.5.1)") {
  const Cloud cloud = cylinder();
  const auto loops = [&](double mu) {
    return stage(mu).set("max_edge", "0.3 m").run(cloud).measure("loops");
  };
  CHECK(loops(1.5) > loops(6.0) + 5);
}

TEST_CASE("a sphere is covered") {
  const auto out = stage(3.0).run(sphere(1000));
  CHECK(quality(out.mesh()).area == Approx(4.0 * std::numbers::pi).epsilon(0.02));
}

TEST_CASE("a scanned sail: near the truth, and not whole, as the thesis found") {
  const Cloud cloud = sail().cloud.has("normals") ? sail().cloud : with_normals(sail().cloud);
  const auto table_3_32 = Stage("meshing.greedy_projection")
                              .set("mu", 7)
                              .set("neighbours", "50")
                              .set("min_angle", "30 deg")
                              .set("max_angle", "150 deg")
                              .set("max_surface_angle", "20 deg")
                              .set("max_edge", "0.3 m")
                              .run(cloud);
  CHECK(quality(table_3_32.mesh()).loops + 1 - quality(table_3_32.mesh()).manifold > 1);
  const auto out = Stage("meshing.greedy_projection").run(cloud);
  CHECK(deviation(out.mesh(), sail().truth).measure("rms") < 0.001);
  CHECK(quality(out.mesh()).area == Approx(quality(sail().truth).area).epsilon(0.02));
  CHECK(share_towards_sensor(out.mesh()) > 0.99);
}

TEST_CASE("normals that differ too much are not joined") {
  Cloud cloud = flat(15);
  Points normals(3, 225);
  for (int i = 0; i < 225; ++i)
    normals.col(i) = Eigen::Vector3f(i / 15 < 8 ? -0.5F : 0.5F, 0.0F, 0.8660254F);
  cloud = cloud.with("normals", velum::Column(normals));
  const auto out = stage(1.5).set("max_surface_angle", "20 deg").run(cloud);
  CHECK(quality(out.mesh()).parts == 2);
  CHECK(quality(out.mesh()).area == Approx(13.0 / 14.0));
}

TEST_CASE("points on each other and normals without length are left out, columns kept") {
  Points points(3, 2 * 225);
  points.leftCols(225) = flat(15).positions();
  points.rightCols(225) = points.leftCols(225).eval();
  Points normals = Points::Zero(3, 450);
  normals.row(2).setOnes();
  normals.col(0).setZero();
  const velum::VectorXu8 mark = velum::VectorXu8::Constant(450, 3);
  const Cloud cloud =
      Cloud(points).with("normals", velum::Column(normals)).with("mark", velum::Column(mark));
  const auto out = stage(1.5).set("max_edge", "0.2 m").run(cloud);
  CHECK(out.mesh().vertices().size() <= 224);
  CHECK(out.mesh().vertices().size() >= 210);
  CHECK(out.mesh().vertices().has("mark"));
}

TEST_CASE("a cloud without normals is refused, one of three points makes no triangle") {
  CHECK_THROWS_AS(stage(2.0).run(flat(5)), velum::Error);
  const Cloud three = with_normals(flat(5)).select(std::vector<int>{0, 1, 5});
  const auto out = stage(2.0).run(three);
  CHECK(out.mesh().empty());
  CHECK(out.warnings.size() == 1);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("meshing.greedy_projection")) FAIL_CHECK(fault);
}
