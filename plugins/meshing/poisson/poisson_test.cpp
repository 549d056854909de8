// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "mesh/test_shapes.hpp"

using velum::Cloud;
using velum::Points;
using velum::test::Stage;
using namespace velum::mesh::test;

namespace {

Stage stage(const char* depth) {
  Stage made("meshing.poisson");
  made.set("depth", depth);
  return made;
}

/// A mesh of the flat unit square, to measure distances from.
velum::Mesh square() {
  return Stage("meshing.delaunay_projected").run(flat(11)).mesh();
}

}  // namespace

TEST_CASE("a sphere, which is closed, comes out closed and near the sphere") {
  const auto out = stage("6").run(sphere(3000));
  const Quality q = quality(out.mesh());
  CHECK(q.loops == 0);
  CHECK(q.manifold == 1);
  CHECK(q.area == Approx(4.0 * std::numbers::pi).epsilon(0.01));
  const auto p = out.mesh().positions();
  CHECK((p.colwise().norm().array() - 1.0F).abs().maxCoeff() < 0.02F);
  const auto normals = out.mesh().vertices().normals();
  CHECK((p.array() * normals.array()).colwise().sum().minCoeff() > 0.8F);
}

TEST_CASE("an open sheet is closed by wings, which the thesis could not trim by distance") {
  const Cloud cloud = with_normals(flat(41));
  const auto whole = stage("6").set("min_density", "0").run(cloud);
  CHECK(quality(whole.mesh()).area > 1.15);
  const auto near = stage("6").set("min_density", "0").set("max_distance", "0.02 m").run(cloud);
  CHECK(quality(near.mesh()).area < quality(whole.mesh()).area);
  CHECK(quality(near.mesh()).area > 1.0);
}

TEST_CASE("trimmed by density the sheet ends where its points do") {
  const auto out = stage("6").run(with_normals(flat(41)));
  const Quality q = quality(out.mesh());
  CHECK(q.loops == 1);
  CHECK(q.area == Approx(1.0).epsilon(0.05));  // half a spacing around it
  CHECK(q.border == Approx(4.0).epsilon(0.1));
  const auto error = deviation(out.mesh(), square());
  CHECK(error.measure("rms") < 0.002);
  CHECK(error.measure("max") < 0.03);
  CHECK(share_towards_sensor(out.mesh()) > 0.99);
}

TEST_CASE("the border is cut smoothly: more density leaves less area, step by step") {
  const Cloud cloud = with_normals(bent(41));
  double last = 100.0;
  for (const char* density : {"0.4", "0.55", "0.7", "0.85"}) {
    const double area = quality(stage("6").set("min_density", density).run(cloud).mesh()).area;
    CHECK(area < last);
    last = area;
  }
}

TEST_CASE("sparser points inside are no border: density counts relative to what is around") {
  const Cloud all = bent(61);
  std::vector<int> kept;
  for (int i = 0; i < all.size(); ++i)
    if (all.positions()(1, i) < 0.7F || i % 3 == 0) kept.push_back(i);
  const auto out = stage("5").run(with_normals(all.select(kept)));
  CHECK(quality(out.mesh()).holes <= 1);
  CHECK(out.mesh().positions().row(1).maxCoeff() > 0.95F);
}

TEST_CASE("a scanned sail: smooth and near the truth inside, its border not") {
  const Cloud cloud = sail().cloud.has("normals") ? sail().cloud : with_normals(sail().cloud);
  const auto out = stage("6").run(cloud);
  const auto error = deviation(out.mesh(), sail().truth);
  CHECK(error.measure("back_rms") < 0.003);
  CHECK(quality(out.mesh()).area == Approx(quality(sail().truth).area).epsilon(0.03));
  CHECK(quality(out.mesh()).manifold == 1);
  CHECK(quality(out.mesh()).border > quality(sail().truth).border);
  const auto by_distance =
      stage("6").set("min_density", "0").set("max_distance", "2 spacing").run(cloud);
  CHECK(error.measure("rms") < deviation(by_distance.mesh(), sail().truth).measure("rms"));
}

TEST_CASE("normals that point to all sides end in a result or an error, not in a crash") {
  velum::Random random(3);
  Cloud cloud = bent(21);
  Points normals(3, cloud.size());
  for (velum::Index i = 0; i < cloud.size(); ++i)
    normals.col(i) = Eigen::Vector3d(random.gaussian(), random.gaussian(), random.gaussian())
                         .normalized()
                         .cast<float>();
  cloud = cloud.with("normals", velum::Column(normals));
  try {
    CHECK(quality(stage("6").run(cloud).mesh()).area >= 0.0);
  } catch (const velum::Error& error) {
    CHECK(error.fault() == velum::Fault::stage);
  }
}

TEST_CASE("normals without length are left out and said; divides beyond the depth are refused") {
  Cloud cloud = with_normals(bent(31));
  Points normals = cloud.normals();
  normals.leftCols(40).setZero();
  cloud = cloud.with("normals", velum::Column(normals));
  CHECK(stage("5").run(cloud).warnings.size() == 1);
  CHECK_THROWS_AS(stage("5").set("iso_divide", "6").run(cloud), velum::Error);
  CHECK_THROWS_AS(stage("5").run(bent(5)), velum::Error);
  CHECK(stage("5").run(with_normals(flat(3))).mesh().empty());
}

TEST_CASE("it runs in a process of its own") {
  CHECK(Stage("meshing.poisson").info().isolated);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("meshing.poisson", {{"depth", "5"}}))
    FAIL_CHECK(fault);
}
