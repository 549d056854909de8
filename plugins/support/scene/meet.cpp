// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "scene/caster.hpp"

namespace velum::scene {
namespace {

using Eigen::Vector3d;

Ray local(const Ray& ray, const Pose& pose) {
  const Eigen::Matrix3d turn = pose.linear().transpose();
  return {turn * (ray.from - pose.translation()), turn * ray.along};
}

std::optional<double> nearer(const Reach& reach, double first, double second) {
  if (first > second) std::swap(first, second);
  for (const double range : {first, second})
    if (range >= reach.near && range <= reach.far) return range;
  return std::nullopt;
}

}  // namespace

std::optional<double> meet(const Plane& plane, const Ray& ray, const Reach& reach) {
  const Ray own = local(ray, plane.pose);
  const double range = -own.from.z() / own.along.z();  // infinite or NaN when parallel: no hit
  if (!(range >= reach.near && range <= reach.far)) return std::nullopt;
  const Vector3d at = own.from + range * own.along;
  if (std::abs(at.x()) > plane.half_x || std::abs(at.y()) > plane.half_y) return std::nullopt;
  return range;
}

std::optional<double> meet(const Box& box, const Ray& ray, const Reach& reach) {
  const Ray own = local(ray, box.pose);
  double enter = -std::numeric_limits<double>::infinity();
  double leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (own.along[axis] == 0.0) {
      if (std::abs(own.from[axis]) > box.half[axis]) return std::nullopt;
      continue;
    }
    const double a = (-box.half[axis] - own.from[axis]) / own.along[axis];
    const double b = (box.half[axis] - own.from[axis]) / own.along[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (enter > leave) return std::nullopt;
  return nearer(reach, enter, leave);
}

std::optional<double> meet(const Ellipsoid& shape, const Ray& ray, const Reach& reach) {
  const Ray own = local(ray, shape.pose);
  // In coordinates scaled by the axes it is the unit sphere.
  const Vector3d from = own.from.cwiseQuotient(shape.semi_axes);
  const Vector3d along = own.along.cwiseQuotient(shape.semi_axes);
  const double a = along.squaredNorm();
  const double half_b = from.dot(along);
  const double c = from.squaredNorm() - 1.0;
  const double root = half_b * half_b - a * c;
  if (root < 0.0) return std::nullopt;
  return nearer(reach, (-half_b - std::sqrt(root)) / a, (-half_b + std::sqrt(root)) / a);
}

std::optional<double> meet(const Cylinder& cylinder, const Ray& ray, const Reach& reach) {
  const Vector3d axis = (cylinder.to - cylinder.from).normalized();
  const double height = (cylinder.to - cylinder.from).norm();
  const Vector3d offset = ray.from - cylinder.from;
  const double rise = ray.along.dot(axis);
  const double start = offset.dot(axis);
  const Vector3d across = ray.along - rise * axis;
  const Vector3d away = offset - start * axis;
  const double a = across.squaredNorm();
  const double half_b = across.dot(away);
  const double c = away.squaredNorm() - cylinder.radius * cylinder.radius;
  const double root = half_b * half_b - a * c;
  if (root < 0.0) return std::nullopt;
  // The stretch inside the infinite cylinder, cut by the two ends.
  double enter = -std::numeric_limits<double>::infinity();
  double leave = std::numeric_limits<double>::infinity();
  if (a > 0.0) {
    enter = (-half_b - std::sqrt(root)) / a;
    leave = (-half_b + std::sqrt(root)) / a;
  } else if (c > 0.0) {
    return std::nullopt;
  }
  if (rise != 0.0) {
    const double low = -start / rise;
    const double high = (height - start) / rise;
    enter = std::max(enter, std::min(low, high));
    leave = std::min(leave, std::max(low, high));
  } else if (start < 0.0 || start > height) {
    return std::nullopt;
  }
  if (enter > leave) return std::nullopt;
  return nearer(reach, enter, leave);
}

std::optional<double> meet(const Cone& cone, const Ray& ray, const Reach& reach) {
  const Vector3d axis = (cone.base - cone.apex).normalized();
  const double height = (cone.base - cone.apex).norm();
  const Vector3d offset = ray.from - cone.apex;
  const double rise = ray.along.dot(axis);
  const double start = offset.dot(axis);
  const double slope = cone.radius / height;
  // (distance from the axis)² = (slope · height below the apex)², both linear along the ray.
  const double wide = 1.0 + slope * slope;
  const double a = 1.0 - wide * rise * rise;
  const double half_b = offset.dot(ray.along) - wide * start * rise;
  const double c = offset.squaredNorm() - wide * start * start;
  std::optional<double> best;
  const auto offer = [&](double range) {
    if (range >= reach.near && range <= reach.far && (!best || range < *best)) best = range;
  };
  const auto offer_side = [&](double range) {
    const double depth = start + range * rise;
    if (depth >= 0.0 && depth <= height) offer(range);
  };
  const double root = half_b * half_b - a * c;
  if (std::abs(a) < 1e-12) {  // along a line of the cone: it meets the side once
    if (half_b != 0.0) offer_side(-0.5 * c / half_b);
  } else if (root >= 0.0) {
    offer_side((-half_b - std::sqrt(root)) / a);
    offer_side((-half_b + std::sqrt(root)) / a);
  }
  if (rise != 0.0) {
    const double range = (height - start) / rise;
    if ((ray.from + range * ray.along - cone.base).squaredNorm() <= cone.radius * cone.radius)
      offer(range);
  }
  return best;
}

}  // namespace velum::scene
