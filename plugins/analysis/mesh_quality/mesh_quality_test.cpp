// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <numbers>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Mesh;
using velum::Points;
using velum::Table;
using velum::Triangles;
using velum::test::Stage;

namespace {

Mesh mesh_of(std::initializer_list<Eigen::Vector3f> vertices,
             std::initializer_list<Eigen::Vector3i> faces) {
  Points points(3, static_cast<velum::Index>(vertices.size()));
  velum::Index i = 0;
  for (const auto& v : vertices) points.col(i++) = v;
  Triangles triangles(3, static_cast<velum::Index>(faces.size()));
  i = 0;
  for (const auto& f : faces) triangles.col(i++) = f;
  return Mesh(Cloud(std::move(points)), std::move(triangles));
}

velum::test::Outcome quality(const Mesh& mesh) {
  return Stage("analysis.mesh_quality").run(mesh);
}

/// The ring between a square of side 3 and one of side 1.
Mesh ring() {
  return mesh_of(
      {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}},
      {{0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 6, 5}, {2, 3, 6}, {3, 7, 6}, {3, 0, 7}, {0, 4, 7}});
}

}  // namespace

TEST_CASE("a right triangle: angles, edges, border") {
  const auto out = quality(mesh_of({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}));
  CHECK(out.measure("min_angle") == Approx(std::atan(3.0 / 4.0)));
  CHECK(out.measure("edge_ratio") == Approx(5.0 / 3.0));
  CHECK(out.measure("border_length") == Approx(12.0));
  CHECK(out.measure("area") == Approx(6.0));
  CHECK(out.measure("loops") == 1);
  CHECK(out.measure("holes") == 0);
  CHECK(out.measure("manifold") == 1);
}

TEST_CASE("a ring has a border and a hole, longest first") {
  const auto out = quality(ring());
  CHECK(out.measure("loops") == 2);
  CHECK(out.measure("holes") == 1);
  CHECK(out.measure("border_length") == Approx(16.0));
  const auto& table = out.get<Table>();
  CHECK(table.number(0, "length") == Approx(12.0));
  CHECK(table.number(1, "length") == Approx(4.0));
  CHECK(table.number(1, "vertices") == 4);
}

TEST_CASE("every angle is in the histogram once") {
  const auto out = quality(ring());
  const auto& table = std::get<Table>(*out.results.at(1));
  double sum = 0.0;
  for (std::size_t row = 0; row < table.size(); ++row) sum += table.number(row, "angles");
  CHECK(sum == 24);
}

TEST_CASE("a closed mesh has no border and no hole") {
  const auto out = quality(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                   {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}));
  CHECK(out.measure("loops") == 0);
  CHECK(out.measure("holes") == 0);
  CHECK(out.measure("manifold") == 1);
}

TEST_CASE("two sheets are two parts, none of whose borders is a hole") {
  const auto out = quality(mesh_of(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}}, {{0, 1, 2}, {3, 4, 5}}));
  CHECK(out.measure("parts") == 2);
  CHECK(out.measure("loops") == 2);
  CHECK(out.measure("holes") == 0);
}

TEST_CASE("three triangles on an edge and sheets that touch at a vertex are not manifold") {
  const auto edge = quality(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                                    {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  CHECK(edge.measure("manifold") == 0);
  CHECK(edge.measure("non_manifold_edges") == 1);
  const auto pinch = quality(
      mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}));
  CHECK(pinch.measure("manifold") == 0);
  CHECK(pinch.measure("pinched_vertices") == 1);
}

TEST_CASE("a triangle without area is counted and spoils nothing else") {
  const auto out =
      quality(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 1, 3}}));
  CHECK(out.measure("degenerate") == 1);
  CHECK(out.measure("min_angle") == 0.0);
  CHECK(out.measure("edge_ratio") == Approx(std::numbers::sqrt2));
}

TEST_CASE("an empty mesh has no triangles and no border") {
  const auto out = quality(Mesh());
  CHECK(out.measure("triangles") == 0);
  CHECK(out.measure("loops") == 0);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("analysis.mesh_quality")) FAIL_CHECK(fault);
}
