// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "scene/caster.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "velum/random.hpp"

using namespace velum;
using namespace velum::scene;
using Eigen::Vector3d;

namespace {

const Reach kAnywhere{};

Ray towards(const Vector3d& from, const Vector3d& to) {
  return {from, (to - from).normalized()};
}

Pose tilted() {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  pose.translation() << 1.0, -2.0, 0.5;
  return pose;
}

Scene with(Shape shape) {
  Scene scene;
  scene.objects.push_back({"thing", 1, {std::move(shape)}});
  return scene;
}

}  // namespace

TEST_CASE("a plane is met where its equation says, inside its sides only") {
  Plane plane;
  plane.pose.translation().z() = -2.0;
  plane.half_x = 3.0;
  plane.half_y = 1.0;
  const auto range = meet(plane, towards({0, 0, 0}, {2, 0.5, -2}), kAnywhere);
  REQUIRE(range);
  CHECK(*range == Approx(Vector3d(2, 0.5, -2).norm()));
  CHECK_FALSE(meet(plane, towards({0, 0, 0}, {0, 1.1, -2}), kAnywhere));
  CHECK_FALSE(meet(plane, {{0, 0, 0}, {1, 0, 0}}, kAnywhere));  // parallel
  CHECK_FALSE(meet(plane, {{0, 0, 0}, {0, 0, 1}}, kAnywhere));  // behind
}

TEST_CASE("an ellipsoid is met at its near side, from inside at its far side") {
  const Ellipsoid shape{tilted(), {2.0, 1.0, 0.5}};
  const Vector3d axis = shape.pose.linear().col(0);
  const auto outside = meet(shape, {shape.pose.translation() - 5.0 * axis, axis}, kAnywhere);
  REQUIRE(outside);
  CHECK(*outside == Approx(3.0));
  const auto inside = meet(shape, {shape.pose.translation(), axis}, kAnywhere);
  REQUIRE(inside);
  CHECK(*inside == Approx(2.0));
  CHECK_FALSE(meet(shape, {shape.pose.translation() - 5.0 * axis, -axis}, kAnywhere));
}

TEST_CASE("a box and a cylinder are met at their sides and ends") {
  const Box box{tilted(), {1.0, 2.0, 3.0}};
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d out = box.pose.linear().col(axis);
    const auto range = meet(box, {box.pose.translation() + 10.0 * out, -out}, kAnywhere);
    REQUIRE(range);
    CHECK(*range == Approx(10.0 - box.half[axis]));
  }
  const Cylinder cylinder{{0, 0, 0}, {0, 0, 2}, 0.1};
  CHECK(meet(cylinder, {{1, 0, 1}, {-1, 0, 0}}, kAnywhere).value() == Approx(0.9));
  CHECK(meet(cylinder, {{0.05, 0, 5}, {0, 0, -1}}, kAnywhere).value() == Approx(3.0));
  CHECK_FALSE(meet(cylinder, {{1, 0, 2.1}, {-1, 0, 0}}, kAnywhere));
  CHECK_FALSE(meet(cylinder, {{0.2, 0, 5}, {0, 0, -1}}, kAnywhere));
}

TEST_CASE("a cone is met at its side and its base, above its apex never") {
  const Cone cone{{0, 0, 2}, {0, 0, 0}, 1.0};
  CHECK(meet(cone, {{5, 0, 1}, {-1, 0, 0}}, kAnywhere).value() == Approx(4.5));
  CHECK(meet(cone, {{0.25, 0, 5}, {0, 0, -1}}, kAnywhere).value() == Approx(3.5));
  CHECK(meet(cone, {{0.5, 0, -3}, {0, 0, 1}}, kAnywhere).value() == Approx(3.0));
  CHECK(meet(cone, {{0, 0, 0.5}, {1, 0, 0}}, kAnywhere).value() == Approx(0.75));  // from inside
  CHECK_FALSE(meet(cone, {{5, 0, 2.5}, {-1, 0, 0}}, kAnywhere));
  CHECK_FALSE(meet(cone, {{5, 0, -0.1}, {-1, 0, 0}}, kAnywhere));
  CHECK_FALSE(meet(cone, {{1.1, 0, 5}, {0, 0, -1}}, kAnywhere));
  // Parallel to a line of the side.
  const Vector3d line = Vector3d(1, 0, -2).normalized();
  CHECK(meet(cone, {{-3, 0, 6}, line}, kAnywhere).value() == Approx(2.5 * std::sqrt(5.0)));
}

TEST_CASE("nothing nearer or farther than the reach is met") {
  const Plane plane;
  const Ray ray{{0, 0, 5}, {0, 0, -1}};
  CHECK(meet(plane, ray, {1.0, 6.0}));
  CHECK_FALSE(meet(plane, ray, {5.5, 6.0}));
  CHECK_FALSE(meet(plane, ray, {1.0, 4.0}));
}

TEST_CASE("triangles of a closed form are met where the closed form is") {
  const Object object{"ball", 1, {Ellipsoid{tilted(), {1.0, 0.8, 0.6}}}};
  constexpr double kError = 1e-4;
  const Caster exact(with(object.shapes.front()));
  const Caster cut(with(triangulate(object, kError)));
  Random random(7);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d from =
        tilted().translation() +
        4.0 * Vector3d(random.gaussian(), random.gaussian(), random.gaussian()).normalized();
    const Vector3d to = tilted() * Vector3d(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3),
                                            random.uniform(-0.3, 0.3));
    const auto a = exact.cast(towards(from, to), kAnywhere);
    const auto b = cut.cast(towards(from, to), kAnywhere);
    REQUIRE((a && b));
    CHECK(std::abs(a->range - b->range) < 2.0 * kError);
    ++hits;
  }
  CHECK(hits == 2000);
}

TEST_CASE("a cone's triangles lie on it and face outwards") {
  const Object object{"hat", 1, {Cone{{0, 0, 2}, {0, 0, 0}, 1.0}}};
  const TriangleSet set = triangulate(object, 1e-4);
  double area = 0.0;
  for (Index i = 0; i < set.triangles.cols(); ++i) {
    const Vector3d a = set.vertices.col(set.triangles(0, i));
    const Vector3d b = set.vertices.col(set.triangles(1, i));
    const Vector3d c = set.vertices.col(set.triangles(2, i));
    const Vector3d normal = (b - a).cross(c - a);
    area += 0.5 * normal.norm();
    CHECK(normal.dot((a + b + c) / 3.0 - Vector3d(0, 0, 0.5)) > 0.0);
  }
  CHECK(area == Approx(std::numbers::pi * (1.0 + std::sqrt(5.0))).epsilon(1e-3));
}

TEST_CASE("no ray slips between the triangles of a sheet") {
  TriangleSet set;
  set.vertices.resize(3, 9);
  for (Index i = 0; i < 9; ++i)
    set.vertices.col(i) << static_cast<double>(i % 3), static_cast<double>(i / 3), 0.0;
  set.triangles.resize(3, 8);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const int a = 3 * j + i;
      set.triangles.col(2 * (2 * j + i)) << a, a + 1, a + 4;
      set.triangles.col(2 * (2 * j + i) + 1) << a, a + 4, a + 3;
    }
  const Caster caster(with(set));
  for (int i = 1; i < 200; ++i) {
    const double s = 0.01 * i;  // along shared edges and through shared corners
    CHECK(caster.cast({{s, 1.0, 3.0}, {0, 0, -1}}, kAnywhere));
    CHECK(caster.cast({{s, s, 3.0}, {0, 0, -1}}, kAnywhere));
  }
}

TEST_CASE("of several objects the nearest is seen") {
  Scene scene;
  Plane far;
  far.pose.translation().z() = -3.0;
  scene.objects.push_back({"far", 1, {far}});
  scene.objects.push_back({"near", 2, {Plane{}}});
  const Caster caster(scene);
  const auto hit = caster.cast({{0, 0, 1}, {0, 0, -1}}, kAnywhere);
  REQUIRE(hit);
  CHECK(hit->object == 1);
  CHECK(hit->range == Approx(1.0));
}

TEST_CASE("the incidence of a ray is that of the surface that it hits") {
  const double slope = 0.3;
  const Vector3d along = Vector3d(std::sin(slope), 0, -std::cos(slope));
  const auto incidence = [](const Caster& caster, const Ray& ray) {
    const auto hit = caster.cast(ray, kAnywhere);
    return hit ? caster.incidence(ray, *hit) : -1.0;
  };
  TriangleSet sheet;
  sheet.vertices.resize(3, 3);
  sheet.vertices << -9, 9, 0, -9, -9, 9, 0, 0, 0;
  sheet.triangles.resize(3, 1);
  sheet.triangles << 0, 1, 2;
  Box box;
  for (const Shape& shape :
       {Shape(Plane{}), Shape(box), Shape(sheet), Shape(Cylinder{{0, 0, -1}, {0, 0, 0}, 5.0}),
        Shape(Cone{{0, 0, -1}, {0, 0, 0}, 5.0})})
    CHECK(incidence(Caster(with(shape)), {{0, 0, 3}, along}) == Approx(slope));
  // On curved sides: a ball met half its radius off the axis, a cylinder likewise, a cone's side.
  const double half = std::asin(0.5);
  const Ray off{{0.5, 0, 3}, {0, 0, -1}};
  CHECK(incidence(Caster(with(Ellipsoid{Pose::Identity(), {1, 1, 1}})), off) == Approx(half));
  CHECK(incidence(Caster(with(Cylinder{{0, -1, 0}, {0, 1, 0}, 1.0})), off) == Approx(half));
  CHECK(incidence(Caster(with(Cone{{0, 0, 1}, {0, 0, 0}, 1.0})), off) ==
        Approx(std::numbers::pi / 4.0));
}
