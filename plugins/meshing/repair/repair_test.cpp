// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "mesh/build.hpp"
#include "mesh/test_shapes.hpp"

using velum::Cloud;
using velum::Index;
using velum::Mesh;
using velum::Points;
using velum::Triangles;
using velum::mesh::Triangle;
using velum::test::Stage;
using namespace velum::mesh::test;

namespace {

Mesh sheet(const Cloud& cloud) {
  return Stage("meshing.delaunay_projected").run(cloud).mesh();
}

Stage repair() {
  Stage made("meshing.repair");
  made.set("min_angle", "0 deg");
  return made;
}

/// The mesh without the triangles that `drop` says, over all its vertices.
template <class Drop>
Mesh without(const Mesh& mesh, const Drop& drop) {
  std::vector<Triangle> kept;
  for (const Triangle& t : velum::mesh::triangles_of(mesh)) {
    const Eigen::Vector3f middle =
        (mesh.positions().col(t[0]) + mesh.positions().col(t[1]) + mesh.positions().col(t[2])) / 3;
    if (!drop(middle)) kept.push_back(t);
  }
  return velum::mesh::mesh_over(kept, mesh.vertices());
}

double min_angle(const Mesh& mesh) {
  return Stage("analysis.mesh_quality").run(mesh).measure("min_angle");
}

constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace

TEST_CASE("a sound mesh stays as it is, columns and all") {
  const Mesh mesh = sheet(with_normals(bent(21)));
  const auto out = repair().run(mesh);
  CHECK(out.mesh().size() == mesh.size());
  CHECK(out.mesh().positions() == mesh.positions());
  CHECK(out.mesh().vertices().has("normals"));
  for (const char* name : {"triangles_dropped", "vertices_split", "triangles_turned",
                           "slivers_removed", "holes_closed", "islands_dropped"})
    CHECK(out.measure(name) == 0);
}

TEST_CASE("triangles that were turned at random agree again, and look at the sensor") {
  const Mesh mesh = sheet(bent(21));
  Triangles mixed = mesh.triangles();
  velum::Random random(3);
  for (Index t = 0; t < mixed.cols(); ++t)
    if (random.uniform() < 0.5) std::swap(mixed(0, t), mixed(1, t));
  const auto out = repair().run(Mesh(mesh.vertices(), mixed));
  CHECK(quality(out.mesh()).manifold == 1);
  CHECK(share_towards_sensor(out.mesh()) == 1.0);
  CHECK(out.measure("triangles_turned") > 300);
}

TEST_CASE("doubles go, and what stands on an edge is cut off and dropped as an island") {
  const Mesh mesh = sheet(flat(11));
  Points points(3, mesh.vertices().size() + 1);
  points.leftCols(mesh.vertices().size()) = mesh.positions();
  points.rightCols(1) << 0.5F, 0.5F, 0.3F;
  Triangles more(3, mesh.size() + 2);
  more.leftCols(mesh.size()) = mesh.triangles();
  more.col(mesh.size()) << more(1, 0), more(2, 0), more(0, 0);
  more.col(mesh.size() + 1) << more(0, 90), more(1, 90), static_cast<int>(points.cols()) - 1;
  const Mesh bad(Cloud(points), more);
  CHECK(quality(bad).manifold == 0);
  const auto out = repair().run(bad);
  CHECK(out.measure("triangles_dropped") == 1);
  CHECK(out.measure("islands_dropped") == 1);
  CHECK(quality(out.mesh()).manifold == 1);
  CHECK(quality(out.mesh()).area == Approx(1.0));
}

TEST_CASE("two sheets that touch at a vertex get a vertex each") {
  Points points(3, 5);
  points << 0, 1, 0, -1, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0, 0;
  Triangles triangles(3, 2);
  triangles << 0, 0, 1, 3, 2, 4;
  const auto out = repair().run(Mesh(Cloud(points), triangles));
  CHECK(out.mesh().vertices().size() == 6);
  CHECK(out.measure("vertices_split") == 1);
  CHECK(quality(out.mesh()).manifold == 1);
}

TEST_CASE("a Moebius strip is cut once, and then has two sides") {
  constexpr int kSteps = 40;
  Points points(3, 2 * kSteps);
  Triangles triangles(3, 2 * kSteps);
  for (int i = 0; i < kSteps; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kSteps;
    for (int j = 0; j < 2; ++j) {
      const double w = 0.2 * (2 * j - 1);
      const double r = 1.0 + w * std::cos(a / 2.0);
      points.col(2 * i + j) =
          Eigen::Vector3d(r * std::cos(a), r * std::sin(a), w * std::sin(a / 2.0)).cast<float>();
    }
    const bool last = i + 1 == kSteps;
    const int next0 = last ? 1 : 2 * i + 2;
    const int next1 = last ? 0 : 2 * i + 3;
    triangles.col(2 * i) << 2 * i, next0, 2 * i + 1;
    triangles.col(2 * i + 1) << 2 * i + 1, next0, next1;
  }
  const auto out = repair().run(Mesh(Cloud(points), triangles));
  CHECK(quality(out.mesh()).manifold == 1);
  CHECK(out.mesh().size() == 2 * kSteps);
  CHECK(out.measure("vertices_split") == 2);
}

TEST_CASE("small parts are islands, larger ones stay") {
  Points points(3, 441 + 121);
  points.leftCols(441) = flat(21).positions();
  points.rightCols(121) = 0.5F * flat(11).positions();
  points.rightCols(121).row(0).array() += 3.0F;
  const Mesh both =
      Stage("meshing.advancing_front").set("largest_part", "false").run(Cloud(points)).mesh();
  CHECK(quality(repair().set("min_part", 0.3).run(both).mesh()).parts == 1);
  CHECK(quality(repair().set("min_part", 0.2).run(both).mesh()).parts == 2);
  CHECK(quality(repair().set("min_part", 1).run(both).mesh()).area == Approx(1.0).epsilon(0.001));
}

TEST_CASE("holes up to a size are closed, the border and larger holes are not") {
  const Mesh mesh = without(sheet(flat(41)), [](const Eigen::Vector3f& p) {
    return (p.head<2>() - Eigen::Vector2f(0.3F, 0.3F)).norm() < 0.05F ||
           (p.head<2>() - Eigen::Vector2f(0.7F, 0.6F)).norm() < 0.2F;
  });
  REQUIRE(quality(mesh).holes == 2);
  const auto small = repair().set("max_hole", "0.5 m").run(mesh);
  CHECK(small.measure("holes_closed") == 1);
  CHECK(quality(small.mesh()).holes == 1);
  const auto all = repair().set("max_hole", "3 m").run(mesh);
  CHECK(quality(all.mesh()).holes == 0);
  CHECK(quality(all.mesh()).manifold == 1);
  CHECK(quality(all.mesh()).area == Approx(1.0).epsilon(1e-5));
  CHECK(quality(all.mesh()).border == Approx(4.0));
  CHECK(share_towards_sensor(all.mesh()) > 0.99);  // some have no area
}

TEST_CASE("slivers go: needles collapse, caps are flipped, and the border keeps its place") {
  Points points = bent(31).positions();
  points.col(31 * 10 + 10) = points.col(31 * 10 + 11) + Eigen::Vector3f(1e-4F, 0, 0);
  points.col(31 * 20 + 15) = (0.5F * (points.col(31 * 19 + 15) + points.col(31 * 21 + 15))).eval();
  const Mesh mesh = sheet(Cloud(points));
  REQUIRE(min_angle(mesh) < 1.0 * kDegree);
  const auto out = repair().set("min_angle", "2 deg").run(mesh);
  CHECK(out.measure("slivers_removed") >= 1);
  CHECK(min_angle(out.mesh()) >= 2.0 * kDegree);
  CHECK(quality(out.mesh()).manifold == 1);
  CHECK(quality(out.mesh()).holes == 0);
  CHECK(quality(out.mesh()).area == Approx(quality(mesh).area).epsilon(1e-3));
}

TEST_CASE("the needles of a Poisson surface go without a hole") {
  const Mesh mesh = Stage("meshing.poisson").set("depth", "6").run(with_normals(bent(41))).mesh();
  const auto out = repair().set("min_angle", "3 deg").run(mesh);
  CHECK(min_angle(mesh) < 0.5 * kDegree);
  CHECK(min_angle(out.mesh()) > min_angle(mesh));
  CHECK(quality(out.mesh()).holes == quality(mesh).holes);
  CHECK(deviation(out.mesh(), mesh).measure("rms") < 0.002);
}

TEST_CASE("decimation: to a number, and within an error; the border stays to the last vertex") {
  const Mesh mesh = sheet(bent(41));
  const auto few = repair().set("triangles", "800").run(mesh);
  CHECK(few.mesh().size() <= 800);
  CHECK(few.mesh().size() > 600);
  CHECK(quality(few.mesh()).border == Approx(quality(mesh).border).epsilon(1e-5));
  const auto near = repair().set("max_error", "0.002 m").run(mesh);
  CHECK(near.mesh().size() < mesh.size() / 2);
  CHECK(deviation(mesh, near.mesh()).measure("hausdorff") < 0.004);
  CHECK(quality(near.mesh()).manifold == 1);
  CHECK(repair().set("triangles", "1").run(sheet(flat(21))).mesh().size() >= 78);
}

TEST_CASE("smoothing takes noise away and leaves the border where it is") {
  const Mesh mesh = sheet(bent(41, 0.004));
  const Mesh truth = sheet(bent(41));
  const auto out = repair().set("smooth", "10").run(mesh);
  CHECK(deviation(out.mesh(), truth).measure("rms") < 0.7 * deviation(mesh, truth).measure("rms"));
  CHECK(quality(out.mesh()).border == Approx(quality(mesh).border));
}

TEST_CASE("the holes of a greedy projection of a sail are closed") {
  const Cloud cloud = sail().cloud.has("normals") ? sail().cloud : with_normals(sail().cloud);
  const Mesh mesh = Stage("meshing.greedy_projection").run(cloud).mesh();
  const auto out = Stage("meshing.repair").set("max_hole", "0.5 m").run(mesh);
  CHECK(quality(out.mesh()).manifold == 1);
  CHECK(quality(out.mesh()).holes == 0);
  CHECK(quality(out.mesh()).parts == 1);
  CHECK(deviation(out.mesh(), sail().truth).measure("rms") < 0.001);
}

TEST_CASE("conformance") {
  using Settings = std::map<std::string, std::string>;
  for (const Settings& settings :
       {Settings{}, Settings{{"max_hole", "1 m"}, {"smooth", "2"}},
        Settings{{"triangles", "10"}, {"max_error", "0.01 m"}, {"min_angle", "5 deg"}}})
    for (const auto& fault : velum::test::conformance("meshing.repair", settings))
      FAIL_CHECK(fault);
}
