// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <numeric>
#include <velum/random.hpp>

#include "registration/test_context.hpp"
#include "shapes/fit.hpp"
#include "shapes/sampler.hpp"

using namespace velum;
using namespace velum::shapes;
using Eigen::Vector3d;

namespace {

const Shape kShapes[] = {
    {Kind::plane, {1, 2, 3}, Vector3d(1, -2, 2).normalized(), 0.0, 0.0},
    {Kind::sphere, {1, 2, 3}, Vector3d::UnitZ(), 1.5, 0.0},
    {Kind::cylinder, {1, 2, 3}, Vector3d(1, -2, 2).normalized(), 0.7, 0.0},
    {Kind::cone, {1, 2, 3}, Vector3d(1, -2, 2).normalized(), 0.0, 0.4},
};

// A point of the shape and its normal there, over a limited part of it.
std::pair<Vector3d, Vector3d> on(const Shape& shape, Random& random) {
  const Vector3d x = shape.axis.unitOrthogonal();
  const Vector3d y = shape.axis.cross(x);
  const double turn = random.uniform(0.0, 3.0);
  const double along = random.uniform(0.5, 2.0);
  const Vector3d out = std::cos(turn) * x + std::sin(turn) * y;
  switch (shape.kind) {
    case Kind::sphere: {
      const Vector3d n = (out + (along - 1.0) * shape.axis).normalized();
      return {shape.point + shape.radius * n, n};
    }
    case Kind::cylinder:
      return {shape.point + shape.radius * out + along * shape.axis, out};
    case Kind::cone:
      return {
          shape.point + along * (std::cos(shape.angle) * shape.axis + std::sin(shape.angle) * out),
          std::cos(shape.angle) * out - std::sin(shape.angle) * shape.axis};
    default:
      return {shape.point + along * out, shape.axis};
  }
}

bool same(const Shape& a, const Shape& b, double tolerance) {
  if (a.kind != b.kind || std::abs(a.radius - b.radius) > tolerance ||
      std::abs(a.angle - b.angle) > tolerance)
    return false;
  if (a.kind != Kind::sphere && std::abs(a.axis.dot(b.axis)) < 1.0 - tolerance) return false;
  if (a.kind == Kind::plane) return std::abs(a.distance(b.point)) < tolerance;
  if (a.kind == Kind::cylinder) return (a.point - b.point).cross(b.axis).norm() < tolerance;
  return (a.point - b.point).norm() < tolerance;
}

}  // namespace

TEST_CASE("three points with normals give the shape that they lie on") {
  Random random(11);
  for (const Shape& shape : kShapes) {
    int found = 0;
    for (int i = 0; i < 200; ++i) {
      Sample sample;
      for (std::size_t k = 0; k < 3; ++k)
        std::tie(sample.points[k], sample.normals[k]) = on(shape, random);
      sample.normals[1] = -sample.normals[1];  // which side does not matter
      const auto made = through(shape.kind, sample);
      found += made && same(*made, shape, 1e-6);
    }
    INFO(name_of(shape.kind));
    CHECK(found > 180);
  }
}

TEST_CASE("a sample that fixes no shape gives none") {
  Sample sample;
  for (std::size_t k = 0; k < 3; ++k) {
    sample.points[k] = Vector3d(static_cast<double>(k), 0, 0);
    sample.normals[k] = Vector3d::UnitZ();
  }
  for (const Kind kind : kAllKinds) CHECK_FALSE(through(kind, sample));
}

TEST_CASE("a fit goes from near a shape to it, and noise averages out") {
  test::PlainContext context(2);
  Random random(12);
  for (const Shape& shape : kShapes) {
    Points points(3, 4000);
    for (Index i = 0; i < points.cols(); ++i) {
      const auto [p, n] = on(shape, random);
      points.col(i) = (p + 0.01 * random.gaussian() * n).cast<float>();
    }
    std::vector<std::int32_t> all(4000);
    std::iota(all.begin(), all.end(), 0);
    Shape start = shape;
    start.point += Vector3d(0.03, -0.02, 0.04);
    start.axis = (start.axis + Vector3d(0.03, 0.02, -0.01)).normalized();
    start.radius *= 1.05;
    start.angle *= 1.05;
    const Shape fitted = refine(start, points, all, context);
    INFO(name_of(shape.kind));
    CHECK(same(fitted, shape, 0.01));
    CHECK(rms(fitted, points, all, context) == Approx(0.01).epsilon(0.05));
    CHECK(rms(fitted, points, all, context) <= rms(shape, points, all, context));
  }
}

TEST_CASE("the quick test of a point agrees with the exact distance") {
  Random random(13);
  for (const Shape& shape : kShapes)
    with_probe(shape, [&](const auto& probe) {
      for (int i = 0; i < 200; ++i) {
        const Vector3d p(random.uniform(-2, 4), random.uniform(-1, 5), random.uniform(0, 6));
        const auto residual = probe(p.cast<float>(), Eigen::Vector3f::UnitX());
        CHECK(residual.distance == Approx(std::abs(shape.distance(p))).margin(1e-5));
      }
      const auto [p, n] = on(shape, random);
      CHECK(probe(p.cast<float>(), n.cast<float>()).cosine == Approx(1.0).margin(1e-5));
    });
}

TEST_CASE("samples of a deep level lie close together, and removed points are never drawn") {
  Points points(3, 10000);
  Random random(14);
  for (float& x : points.reshaped()) x = static_cast<float>(random.uniform());
  LocalSampler sampler(points);
  REQUIRE(sampler.levels() > 3);
  Eigen::VectorXi labels = Eigen::VectorXi::Constant(10000, -1);
  labels.head(5000).setZero();
  sampler.remove(labels);
  CHECK(sampler.points().size() == 5000);
  int drawn = 0;
  for (int i = 0; i < 500; ++i) {
    const auto three = sampler.draw(random, 3);
    if (!three) continue;
    ++drawn;
    for (const std::int32_t p : *three) {
      CHECK(p >= 5000);
      CHECK((points.col(p) - points.col((*three)[0])).cwiseAbs().maxCoeff() <= 0.126F);
    }
  }
  CHECK(drawn > 100);
}
