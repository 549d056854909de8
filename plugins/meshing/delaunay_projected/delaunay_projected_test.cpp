// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Mesh;
using velum::Points;
using velum::test::Stage;

namespace {

/// A grid of n × n points over the unit square, height by `z`.
template <class Height>
Cloud grid(int n, const Height& z) {
  Points points(3, n * n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = i / (n - 1.0);
      const double y = j / (n - 1.0);
      points.col(i * n + j) << static_cast<float>(x), static_cast<float>(y),
          static_cast<float>(z(x, y));
    }
  }
  return Cloud(std::move(points));
}

Cloud flat(int n) {
  return grid(n, [](double, double) { return 0.0; });
}

Cloud seen_from(const Cloud& cloud, const Eigen::Vector3d& place) {
  velum::Pose pose = velum::Pose::Identity();
  pose.translation() = place;
  return cloud.with_sensors({{"scanner", pose}});
}

struct Quality {
  double holes, loops, manifold, border, area;
};
Quality quality(const Mesh& mesh) {
  const auto out = Stage("analysis.mesh_quality").run(mesh);
  return {out.measure("holes"), out.measure("loops"), out.measure("manifold"),
          out.measure("border_length"), out.measure("area")};
}

}  // namespace

TEST_CASE("a flat grid becomes its square") {
  const auto out = Stage("meshing.delaunay_projected").run(flat(21));
  CHECK(out.mesh().size() == 2 * 20 * 20);
  CHECK(out.mesh().vertices().size() == 21 * 21);
  const Quality q = quality(out.mesh());
  CHECK(q.area == Approx(1.0));
  CHECK(q.border == Approx(4.0));
  CHECK(q.loops == 1);
  CHECK(q.holes == 0);
  CHECK(q.manifold == 1);
}

TEST_CASE("the hull's slivers over a hollow border are trimmed, and no point is lost") {
  // A sheet whose left border is hollow by 0.2.
  Points points(3, 41 * 41);
  for (int i = 0; i <= 40; ++i) {
    for (int j = 0; j <= 40; ++j) {
      const double y = j / 40.0;
      const double left = 0.8 * y * (1.0 - y);
      const double x = left + (1.0 - left) * i / 40.0;
      points.col(i * 41 + j) << static_cast<float>(x), static_cast<float>(y), 0.0F;
    }
  }
  const auto out = Stage("meshing.delaunay_projected").run(Cloud(points));
  CHECK(quality(out.mesh()).area == Approx(1.0 - 0.8 / 6.0).epsilon(0.002));
  CHECK(quality(out.mesh()).loops == 1);
  CHECK(out.measure("unused_points") == 0);
  const auto with =
      Stage("meshing.delaunay_projected").set("trim_slivers", "false").run(Cloud(points));
  CHECK(quality(with.mesh()).area > 0.99 * (1.0 - 0.8 / 6.0) + 0.005);
}

TEST_CASE("edges longer than max_edge go, and with them what hangs on by them") {
  Points points(3, 2 * 121);
  points.leftCols(121) = flat(11).positions();
  points.rightCols(121) = flat(11).positions();
  points.rightCols(121).row(0).array() += 3.0F;
  const Cloud two = Cloud(points).select(std::vector<int>([] {
    std::vector<int> some;
    for (int i = 0; i < 242; ++i)
      if (i < 121 || i % 11 != 0) some.push_back(i);  // the second square is the smaller one
    return some;
  }()));
  const auto out = Stage("meshing.delaunay_projected").set("max_edge", "0.5 m").run(two);
  CHECK(out.mesh().vertices().size() == 121);
  CHECK(quality(out.mesh()).area == Approx(1.0));
  const auto all = Stage("meshing.delaunay_projected").set("max_edge", "5 m").run(two);
  CHECK(quality(all.mesh()).area > 3.5);
}

TEST_CASE("a hole wider than max_edge stays open") {
  const Cloud all = flat(41);
  std::vector<int> outside;
  for (int i = 0; i < all.size(); ++i)
    if ((all.positions().col(i).head<2>() - Eigen::Vector2f(0.5F, 0.5F)).norm() > 0.25F)
      outside.push_back(i);
  const auto out =
      Stage("meshing.delaunay_projected").set("max_edge", "0.1 m").run(all.select(outside));
  CHECK(quality(out.mesh()).holes == 1);
  CHECK(quality(out.mesh()).manifold == 1);
}

TEST_CASE("triangles look at the sensor") {
  for (const double side : {1.0, -1.0}) {
    const Cloud cloud = seen_from(flat(11), {0.5, 0.5, 3.0 * side});
    const Mesh mesh = Stage("meshing.delaunay_projected").run(cloud).mesh();
    const auto t = mesh.triangles();
    const auto p = mesh.positions();
    for (velum::Index i = 0; i < t.cols(); ++i) {
      const Eigen::Vector3f n =
          (p.col(t(1, i)) - p.col(t(0, i))).cross(p.col(t(2, i)) - p.col(t(0, i)));
      CHECK(n.z() * side > 0.0);
    }
    CHECK(mesh.sensors().size() == 1);
  }
}

TEST_CASE("auto takes the scan angles where the best-fit plane folds") {
  // Three quarters of a cylinder around the scanner: no plane sees it without folds.
  Points points(3, 120 * 20);
  for (int i = 0; i < 120; ++i) {
    const double angle = 1.5 * std::numbers::pi * i / 119.0;
    for (int j = 0; j < 20; ++j)
      points.col(i * 20 + j) << static_cast<float>(2.0 * std::cos(angle)),
          static_cast<float>(2.0 * std::sin(angle)), static_cast<float>(0.08 * j);
  }
  const Cloud cloud = seen_from(Cloud(points), {0.0, 0.0, 0.8});
  const auto out = Stage("meshing.delaunay_projected").run(cloud);
  CHECK(out.measure("folds") == 0);
  CHECK(quality(out.mesh()).area == Approx(1.5 * std::numbers::pi * 2.0 * 1.52).epsilon(0.01));
  const auto folded = Stage("meshing.delaunay_projected").set("plane", "best_fit").run(cloud);
  CHECK(folded.measure("folds") > 0);
  REQUIRE(folded.warnings.size() == 1);
  CHECK(folded.warnings[0].find("folds") != std::string::npos);
}

TEST_CASE("the scan angles need a sensor") {
  CHECK_THROWS_WITH(Stage("meshing.delaunay_projected").set("plane", "spherical").run(flat(5)),
                    Catch::Contains("no sensor"));
}

TEST_CASE("points that coincide in the projection are used once") {
  Points points(3, 242);
  points.leftCols(121) = flat(11).positions();
  points.rightCols(121) = flat(11).positions();
  const auto out = Stage("meshing.delaunay_projected").run(Cloud(points));
  CHECK(out.mesh().vertices().size() == 121);
  CHECK(out.measure("unused_points") == 121);
}

TEST_CASE("columns and origin come along, unused points do not") {
  Points points(3, 122);
  points.leftCols(121) = flat(11).positions();
  points.col(121) << 50.0F, 50.0F, 0.0F;  // far off: dropped
  Eigen::VectorXi label = Eigen::VectorXi::LinSpaced(122, 0, 121);
  const Cloud cloud =
      Cloud(points, Eigen::Vector3d(5e6, 4e5, 10.0)).with("label", velum::Column(label));
  const Mesh mesh = Stage("meshing.delaunay_projected").set("max_edge", "1 m").run(cloud).mesh();
  CHECK(mesh.origin() == Eigen::Vector3d(5e6, 4e5, 10.0));
  REQUIRE(mesh.vertices().size() == 121);
  CHECK(mesh.vertices().labels()[120] == 120);
}

TEST_CASE("points on a line give an empty mesh and say so") {
  Points points = Points::Zero(3, 10);
  points.row(0) = Eigen::RowVectorXf::LinSpaced(10, 0.0F, 1.0F);
  const auto out = Stage("meshing.delaunay_projected").run(Cloud(points));
  CHECK(out.mesh().empty());
  CHECK(out.warnings.size() == 1);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("meshing.delaunay_projected"))
    FAIL_CHECK(fault);
}
