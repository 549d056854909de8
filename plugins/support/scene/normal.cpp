// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <cmath>

#include "scene/caster.hpp"

namespace velum::scene {
namespace {

using Eigen::Vector3d;

// A point that close to a flat end lies on it rather than on the side [m].
constexpr double kOnEnd = 1e-9;

}  // namespace

Vector3d normal(const Plane& plane, const Vector3d& /*at*/) {
  return plane.pose.linear().col(2);
}

Vector3d normal(const Box& box, const Vector3d& at) {
  const Vector3d own = box.pose.inverse() * at;
  int side = 0;
  own.cwiseQuotient(box.half).cwiseAbs().maxCoeff(&side);
  return box.pose.linear().col(side);
}

Vector3d normal(const Ellipsoid& shape, const Vector3d& at) {
  const Vector3d own = shape.pose.inverse() * at;
  const Vector3d gradient = own.cwiseQuotient(shape.semi_axes.cwiseAbs2());
  return shape.pose.linear() * gradient.normalized();
}

Vector3d normal(const Cylinder& cylinder, const Vector3d& at) {
  const Vector3d axis = (cylinder.to - cylinder.from).normalized();
  const double along = (at - cylinder.from).dot(axis);
  const double height = (cylinder.to - cylinder.from).norm();
  if (along < kOnEnd || along > height - kOnEnd) return axis;
  return (at - cylinder.from - along * axis).normalized();
}

Vector3d normal(const Cone& cone, const Vector3d& at) {
  const Vector3d axis = (cone.base - cone.apex).normalized();
  const double height = (cone.base - cone.apex).norm();
  const double depth = (at - cone.apex).dot(axis);
  if (depth > height - kOnEnd) return axis;
  const Vector3d out = (at - cone.apex - depth * axis).normalized();
  return (height * out - cone.radius * axis).normalized();
}

}  // namespace velum::scene
