// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "mesh/test_shapes.hpp"

using velum::Cloud;
using velum::Points;
using velum::test::Stage;
using namespace velum::mesh::test;

TEST_CASE("a tetrahedron and its middle have all ten faces") {
  Points points(3, 5);
  points << 0, 1, 0, 0, 0.25F, 0, 0, 1, 0, 0.25F, 0, 0, 0, 1, 0.25F;
  const auto out = Stage("meshing.delaunay_3d").set("max_edge", "10 m").run(Cloud(points));
  CHECK(out.measure("tetrahedra") == 4);
  CHECK(out.mesh().size() == 10);
  CHECK(out.measure("unused_points") == 0);
}

TEST_CASE("faces with long edges go, and those of equal length stay") {
  const auto out = Stage("meshing.delaunay_3d").set("max_edge", "0.0708 m").run(flat(21));
  CHECK(out.mesh().size() == 2 * 20 * 20);
  CHECK(Stage("meshing.delaunay_3d").set("max_edge", "0.0706 m").run(flat(21)).mesh().empty());
}

TEST_CASE("points in one plane, where the thesis failed, become their planar triangulation") {
  const auto out = Stage("meshing.delaunay_3d").run(flat(15));
  const Quality q = quality(out.mesh());
  CHECK(q.area == Approx(1.0));
  CHECK(q.border == Approx(4.0));
  CHECK(q.manifold == 1);
  CHECK(share_towards_sensor(out.mesh()) == 1.0);
}

TEST_CASE(
    "even on an even sphere flat tetrahedra stay: the surface is among the faces, not alone") {
  const auto out = Stage("meshing.delaunay_3d").set("max_edge", "0.3 m").run(sphere(500));
  const auto hull = Stage("meshing.advancing_front").run(sphere(500)).mesh();
  CHECK(deviation(out.mesh(), hull).measure("back_max") < 0.01);
  CHECK(quality(out.mesh()).area > 1.2 * quality(hull).area);
  CHECK(quality(out.mesh()).manifold == 0);
}

TEST_CASE("noise makes flat tetrahedra, and the result is no surface (thesis 3.5.2)") {
  const Cloud cloud = bent(31, 0.004);
  const auto out = Stage("meshing.delaunay_3d").run(cloud);
  CHECK(quality(out.mesh()).manifold == 0);
  CHECK(out.measure("non_manifold_edges") > 500);
  CHECK(out.warnings.size() == 1);
  const auto seen = Stage("meshing.delaunay_3d").set("faces", "seen").run(cloud);
  CHECK(seen.measure("non_manifold_edges") < 0.02 * out.measure("non_manifold_edges"));
}

TEST_CASE("what the scanner sees of a clean sheet is that sheet") {
  const Cloud cloud = bent(31);
  const auto out =
      Stage("meshing.delaunay_3d").set("faces", "seen").set("max_edge", "0.08 m").run(cloud);
  const auto best = Stage("meshing.delaunay_projected").run(cloud);
  CHECK(quality(out.mesh()).area == Approx(quality(best.mesh()).area).epsilon(0.01));
  CHECK(share_towards_sensor(out.mesh()) > 0.99);
  CHECK_THROWS_AS(Stage("meshing.delaunay_3d").set("faces", "seen").run(sphere(50)), velum::Error);
}

TEST_CASE("one length does not fit all of a sail (thesis 3.5.2)") {
  const Cloud& cloud = sail().cloud;
  const auto all = Stage("meshing.delaunay_3d").set("max_edge", "6 spacing").run(cloud);
  CHECK(deviation(all.mesh(), sail().truth).measure("rms") < 0.001);
  CHECK(quality(all.mesh()).manifold == 0);
  CHECK(quality(all.mesh()).area > 2.0 * quality(sail().truth).area);
}

TEST_CASE("points on each other count once, and columns are kept") {
  Points points(3, 2 * 25);
  points.leftCols(25) = flat(5).positions();
  points.rightCols(25) = points.leftCols(25).eval();
  velum::VectorXu8 mark(50);
  for (int i = 0; i < 50; ++i) mark[i] = static_cast<std::uint8_t>(i);
  const auto out = Stage("meshing.delaunay_3d")
                       .set("max_edge", "0.5 m")
                       .run(Cloud(points).with("mark", velum::Column(mark)));
  CHECK(out.mesh().vertices().size() == 25);
  CHECK(out.measure("unused_points") == 25);
  CHECK(out.mesh().vertices().column("mark").vector<std::uint8_t>()[24] == 24);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("meshing.delaunay_3d")) FAIL_CHECK(fault);
  for (const auto& fault : velum::test::conformance("meshing.delaunay_3d", {{"faces", "seen"}}))
    FAIL_CHECK(fault);
}
