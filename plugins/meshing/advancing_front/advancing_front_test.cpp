// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "mesh/test_shapes.hpp"

using velum::Cloud;
using velum::Points;
using velum::test::Stage;
using namespace velum::mesh::test;

TEST_CASE("a bent sheet comes out whole, with every point, looking at its sensor") {
  const Cloud cloud = bent(41);
  const auto out = Stage("meshing.advancing_front").run(cloud);
  const Quality q = quality(out.mesh());
  CHECK(q.holes == 0);
  CHECK(q.loops == 1);
  CHECK(q.manifold == 1);
  CHECK(out.measure("unused_points") == 0);
  CHECK(share_towards_sensor(out.mesh()) == 1.0);
  const Quality best = quality(Stage("meshing.delaunay_projected").run(cloud).mesh());
  CHECK(q.area == Approx(best.area).epsilon(0.002));
  CHECK(q.border == Approx(best.border).epsilon(0.01));
}

TEST_CASE("points in one plane, where its tetrahedra are flat") {
  const Quality q = quality(Stage("meshing.advancing_front").run(flat(21)).mesh());
  CHECK(q.area == Approx(1.0).epsilon(1e-4));
  CHECK(q.border == Approx(4.0).epsilon(1e-4));
  CHECK(q.manifold == 1);
}

TEST_CASE("a sphere is closed, and near the sphere") {
  const Cloud cloud = sphere(2000);
  const auto out = Stage("meshing.advancing_front").run(cloud);
  const Quality q = quality(out.mesh());
  CHECK(q.loops == 0);
  CHECK(q.manifold == 1);
  CHECK(out.mesh().size() == 2 * 2000 - 4);
  CHECK(q.area == Approx(4.0 * std::numbers::pi).epsilon(0.005));
}

TEST_CASE("a hole wider than max_edge stays open, and closes where it may") {
  const Cloud all = bent(41);
  std::vector<int> outside;
  for (int i = 0; i < all.size(); ++i)
    if ((all.positions().col(i).head<2>() - Eigen::Vector2f(0.5F, 0.5F)).norm() > 0.15F)
      outside.push_back(i);
  const Cloud cloud = all.select(outside);
  const auto open = Stage("meshing.advancing_front").set("max_edge", "0.1 m").run(cloud);
  CHECK(quality(open.mesh()).holes == 1);
  const auto closed =
      Stage("meshing.advancing_front").set("max_edge", "1 m").set("radius_ratio", 100).run(cloud);
  CHECK(quality(closed.mesh()).holes == 0);
}

TEST_CASE("of two sheets the larger is kept unless all are asked for") {
  Points points(3, 441 + 121);
  points.leftCols(441) = flat(21).positions();
  points.rightCols(121) = 0.5F * flat(11).positions();
  points.rightCols(121).row(0).array() += 3.0F;
  const auto one = Stage("meshing.advancing_front").run(Cloud(points));
  CHECK(one.mesh().vertices().size() == 441);
  CHECK(one.measure("parts_dropped") == 1);
  const auto both =
      Stage("meshing.advancing_front").set("largest_part", "false").run(Cloud(points));
  CHECK(both.mesh().vertices().size() == 441 + 121);
  CHECK(quality(both.mesh()).area == Approx(1.25).epsilon(1e-3));
}

TEST_CASE("a scanned and smoothed sail: one sheet near the truth") {
  const auto out = Stage("meshing.advancing_front").run(sail().cloud);
  const Quality q = quality(out.mesh());
  const Quality truth = quality(sail().truth);
  CHECK(q.holes == 0);
  CHECK(q.loops == 1);
  CHECK(q.manifold == 1);
  CHECK(deviation(out.mesh(), sail().truth).measure("rms") < 0.001);
  CHECK(q.area == Approx(truth.area).epsilon(0.02));
  CHECK(q.border == Approx(truth.border).epsilon(0.03));
  CHECK(share_towards_sensor(out.mesh()) > 0.999);
}

TEST_CASE("noise as large as the spacing breaks it, where the projection does not") {
  const Cloud cloud = bent(61, 0.02);
  const auto out = Stage("meshing.advancing_front").run(cloud);
  CHECK(out.measure("unused_points") + quality(out.mesh()).holes > 20);
}

TEST_CASE("points on each other count once, and columns are kept") {
  Points points(3, 2 * 121);
  points.leftCols(121) = bent(11).positions();
  points.rightCols(121) = points.leftCols(121).eval();
  velum::VectorXu8 mark(242);
  for (int i = 0; i < 242; ++i) mark[i] = static_cast<std::uint8_t>(i);
  const auto out = Stage("meshing.advancing_front")
                       .set("max_edge", "1 m")
                       .run(Cloud(points).with("mark", velum::Column(mark)));
  CHECK(out.measure("unused_points") == 121);
  CHECK(out.mesh().vertices().column("mark").vector<std::uint8_t>()[120] == 120);
}

TEST_CASE("fewer than three points, or points on a line, make no triangle and say so") {
  Points line(3, 20);
  for (int i = 0; i < 20; ++i) line.col(i) << 0.1F * static_cast<float>(i), 0.0F, 0.0F;
  for (const Cloud& cloud : {Cloud(), flat(3).select(std::vector<int>{0, 1}), Cloud(line)}) {
    const auto out = Stage("meshing.advancing_front").set("max_edge", "1 m").run(cloud);
    CHECK(out.mesh().empty());
    CHECK(out.warnings.size() == 1);
  }
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("meshing.advancing_front")) FAIL_CHECK(fault);
}
