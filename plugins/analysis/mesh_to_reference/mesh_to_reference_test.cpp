// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Mesh;
using velum::Points;
using velum::Triangles;
using velum::test::Stage;

namespace {

/// A rectangle from (0, 0) to (w, h) at height z.
Mesh rectangle(float w, float h, float z) {
  Points points(3, 4);
  points.col(0) << 0, 0, z;
  points.col(1) << w, 0, z;
  points.col(2) << w, h, z;
  points.col(3) << 0, h, z;
  Triangles triangles(3, 2);
  triangles.col(0) << 0, 1, 2;
  triangles.col(1) << 0, 2, 3;
  return Mesh(Cloud(std::move(points)), std::move(triangles));
}

velum::test::Outcome compare(const Mesh& mesh, const Mesh& reference) {
  return Stage("analysis.mesh_to_reference").run(mesh, reference);
}

}  // namespace

TEST_CASE("a mesh is nowhere away from itself") {
  const auto out = compare(rectangle(2, 1, 0), rectangle(2, 1, 0));
  CHECK(out.measure("rms") < 1e-9);
  CHECK(out.measure("hausdorff") < 1e-9);
}

TEST_CASE("parallel sheets are as far apart as their planes") {
  const auto out = compare(rectangle(2, 1, 0.25F), rectangle(2, 1, 0));
  for (const char* name : {"rms", "mean", "p95", "hausdorff", "back_rms"})
    CHECK(out.measure(name) == Approx(0.25));
}

TEST_CASE("what sticks out counts one way only") {
  // The mesh covers half of the reference: nothing of it is away, half of the reference is.
  const auto out = compare(rectangle(1, 1, 0), rectangle(2, 1, 0));
  CHECK(out.measure("rms") < 1e-9);
  CHECK(out.measure("back_max") == Approx(1.0));
  CHECK(out.measure("hausdorff") == Approx(1.0));
  // Distances over the reference are 0 on one half and even in (0, 1) on the other.
  CHECK(out.measure("back_mean") == Approx(0.25).epsilon(0.01));
  CHECK(out.measure("back_rms") == Approx(std::sqrt(1.0 / 6.0)).epsilon(0.01));
  CHECK(out.measure("back_p95") == Approx(0.9).epsilon(0.02));
}

TEST_CASE("figures are weighted by area, not by triangle") {
  // One big triangle pair on the reference and a tiny, finely cut patch at height 1.
  Points points(3, 4 + 4);
  points.leftCols(4) = rectangle(2, 1, 0).positions();
  points.rightCols(4) = rectangle(0.01F, 0.01F, 1.0F).positions();
  Triangles triangles(3, 4);
  triangles.leftCols(2) = rectangle(2, 1, 0).triangles();
  triangles.rightCols(2) = rectangle(2, 1, 0).triangles().array() + 4;
  const auto out = compare(Mesh(Cloud(points), triangles), rectangle(2, 1, 0));
  CHECK(out.measure("mean") == Approx(0.0001 / 2.0001).epsilon(0.01));
  CHECK(out.measure("max") == Approx(1.0));
}

TEST_CASE("meshes far from zero about different origins are compared in truth") {
  const Eigen::Vector3d there(5e6, 4e5, 100.0);
  const auto at = [&](float z, const Eigen::Vector3d& shift) {
    const Mesh m = rectangle(2, 1, z);
    return m.with_vertices(Cloud(Points(m.positions()), there + shift));
  };
  const auto out = compare(at(0.0F, {0, 0, 0.002}), at(0.0F, {0, 0, 0}));
  CHECK(out.measure("rms") == Approx(0.002).epsilon(1e-3));
}

TEST_CASE("a sphere of triangles is inside its circumscribed sphere by its sagitta") {
  const auto sphere = [](int n) {
    Points points(3, (n + 1) * 2 * n);
    Triangles triangles(3, 4 * n * n);
    velum::Index t = 0;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j < 2 * n; ++j) {
        const double a = M_PI * i / n, b = M_PI * j / n;
        points.col(i * 2 * n + j) =
            Eigen::Vector3d(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a))
                .cast<float>();
        if (i == n) continue;
        const int k = i * 2 * n + j, right = i * 2 * n + (j + 1) % (2 * n);
        triangles.col(t++) << k, k + 2 * n, right;
        triangles.col(t++) << right, k + 2 * n, right + 2 * n;
      }
    return Mesh(Cloud(points), triangles);
  };
  const auto out = compare(sphere(10), sphere(80));
  const double sagitta = 1.0 - std::cos(M_PI / 20.0);
  CHECK(out.measure("max") < 2.0 * sagitta);
  CHECK(out.measure("mean") > 0.3 * sagitta);
  CHECK(out.measure("hausdorff") >= out.measure("p95"));
  CHECK(out.measure("p95") >= out.measure("mean"));
}

TEST_CASE("a mesh without triangles is refused") {
  CHECK_THROWS_WITH(compare(Mesh(), rectangle(1, 1, 0)), Catch::Contains("no triangles"));
  CHECK_THROWS_WITH(compare(rectangle(1, 1, 0), Mesh()), Catch::Contains("reference"));
}

TEST_CASE("a mesh without area is refused") {
  CHECK_THROWS_WITH(compare(rectangle(1, 0, 0), rectangle(1, 1, 0)), Catch::Contains("area"));
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("analysis.mesh_to_reference"))
    FAIL_CHECK(fault);
}
