// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "mesh/topology.hpp"

#include <catch2/catch.hpp>
#include <velum/random.hpp>

#include "mesh/distance.hpp"

using velum::Cloud;
using velum::Mesh;
using velum::Points;
using velum::Triangles;

namespace {

Mesh make(int vertices, std::initializer_list<std::array<int, 3>> faces) {
  Points points(3, vertices);
  for (int i = 0; i < vertices; ++i)
    points.col(i) << static_cast<float>(i % 3), static_cast<float>(i / 3), 0.0F;
  Triangles triangles(3, static_cast<velum::Index>(faces.size()));
  velum::Index t = 0;
  for (const auto& f : faces) triangles.col(t++) << f[0], f[1], f[2];
  return Mesh(Cloud(std::move(points)), std::move(triangles));
}

}  // namespace

TEST_CASE("a square of two triangles has one border of four vertices") {
  const Mesh mesh = make(5, {{0, 1, 3}, {1, 4, 3}});
  const auto adjacency = velum::mesh::adjacency(mesh.triangles());
  CHECK(adjacency.across[0] == velum::mesh::Triangle{-1, 1, -1});
  CHECK(adjacency.across[1] == velum::mesh::Triangle{-1, -1, 0});
  const auto loops = velum::mesh::border_loops(mesh.triangles(), adjacency);
  REQUIRE(loops.size() == 1);
  CHECK(loops[0] == std::vector<int>{0, 1, 4, 3});
  CHECK(velum::mesh::loop_length(mesh.positions(), loops[0]) == Approx(4.0));
  CHECK(velum::mesh::pinched_vertices(mesh.triangles(), adjacency) == 0);
}

TEST_CASE("a closed tetrahedron has no border") {
  const Mesh mesh = make(4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  const auto adjacency = velum::mesh::adjacency(mesh.triangles());
  CHECK(velum::mesh::border_loops(mesh.triangles(), adjacency).empty());
  CHECK(velum::mesh::components(adjacency).count == 1);
}

TEST_CASE("two triangles that touch at a vertex are two parts, two loops and a pinch") {
  const Mesh mesh = make(5, {{0, 1, 2}, {2, 3, 4}});
  const auto adjacency = velum::mesh::adjacency(mesh.triangles());
  CHECK(velum::mesh::components(adjacency).count == 2);
  CHECK(velum::mesh::border_loops(mesh.triangles(), adjacency).size() == 2);
  CHECK(velum::mesh::pinched_vertices(mesh.triangles(), adjacency) == 1);
}

TEST_CASE("three triangles on one edge, or two that run the same way, are not manifold") {
  const Mesh three = make(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  CHECK(velum::mesh::adjacency(three.triangles()).non_manifold_edges == 1);
  const Mesh turned = make(4, {{0, 1, 2}, {0, 1, 3}});
  CHECK(velum::mesh::adjacency(turned.triangles()).non_manifold_edges == 1);
}

TEST_CASE("an empty mesh has nothing") {
  const auto adjacency = velum::mesh::adjacency(Mesh().triangles());
  CHECK(velum::mesh::border_loops(Mesh().triangles(), adjacency).empty());
  CHECK(velum::mesh::pinched_vertices(Mesh().triangles(), adjacency) == 0);
}

TEST_CASE("the nearest place of a triangle is inside, on an edge or at a corner") {
  const Eigen::Vector3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const auto nearest = [&](double x, double y, double z) {
    return velum::mesh::closest_on_triangle({x, y, z}, a, b, c);
  };
  CHECK(nearest(0.2, 0.3, 5.0).isApprox(Eigen::Vector3d(0.2, 0.3, 0.0)));
  CHECK(nearest(0.5, -2.0, 1.0).isApprox(Eigen::Vector3d(0.5, 0.0, 0.0)));
  CHECK(nearest(2.0, 2.0, 0.0).isApprox(Eigen::Vector3d(0.5, 0.5, 0.0)));
  CHECK(nearest(3.0, -1.0, 0.0).isApprox(b));
  CHECK(nearest(-1.0, -1.0, 0.0).norm() == 0.0);
  CHECK(nearest(-1.0, 0.4, 0.0).isApprox(Eigen::Vector3d(0.0, 0.4, 0.0)));
}

TEST_CASE("the tree finds what a search through all triangles finds") {
  velum::Random random(3);
  Points points(3, 300);
  for (velum::Index i = 0; i < points.size(); ++i)
    points(i) = static_cast<float>(random.uniform(-1.0, 1.0));
  Triangles triangles(3, 200);
  for (velum::Index i = 0; i < triangles.size(); ++i)
    triangles(i) = static_cast<int>(random.below(300));
  const Mesh mesh(Cloud(points), triangles);
  const velum::mesh::DistanceTree tree(mesh);
  for (int q = 0; q < 200; ++q) {
    const Eigen::Vector3d query(random.uniform(-2, 2), random.uniform(-2, 2),
                                random.uniform(-2, 2));
    double best = 1e9;
    for (velum::Index t = 0; t < triangles.cols(); ++t) {
      const auto corner = [&](int i) -> Eigen::Vector3d {
        return points.col(triangles(i, t)).cast<double>();
      };
      best = std::min(
          best, (velum::mesh::closest_on_triangle(query, corner(0), corner(1), corner(2)) - query)
                    .squaredNorm());
    }
    CHECK(tree.closest(query).distance2 == Approx(best));
  }
}
