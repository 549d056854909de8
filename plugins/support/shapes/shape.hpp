// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>
#include <velum/context.hpp>
#include <velum/types.hpp>

namespace velum::shapes {

enum class Kind : std::uint8_t { plane, sphere, cylinder, cone };
inline constexpr std::array kAllKinds = {Kind::plane, Kind::sphere, Kind::cylinder, Kind::cone};
std::string_view name_of(Kind kind);

/// One of the four basic shapes. All are unbounded: a plane without sides, a cylinder without ends,
/// a cone of one nappe without a base.
struct Shape {
  Kind kind = Kind::plane;
  /// A point of the plane, the sphere's centre, a point of the cylinder's axis, the cone's apex.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  /// Unit: the plane's normal, the cylinder's axis, from the cone's apex into it.
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double radius = 0.0;  ///< of sphere and cylinder [m]
  double angle = 0.0;   ///< between the cone's axis and its side [rad]

  /// Signed distance from the surface, positive outside.
  [[nodiscard]] double distance(const Eigen::Vector3d& p) const;
};

/// How a point lies to a surface: distance [m], and cosine of the angle between the normals, both
/// without sign.
struct Residual {
  float distance;
  float cosine;
};

// The four tests in single precision, which all points go through.
struct PlaneProbe {
  Eigen::Vector3f normal;
  Eigen::Vector3f point;
  explicit PlaneProbe(const Shape& s)
      : normal(s.axis.cast<float>()), point(s.point.cast<float>()) {}
  Residual operator()(const Eigen::Vector3f& p, const Eigen::Vector3f& n) const {
    return {std::abs(normal.dot(p - point)), std::abs(normal.dot(n))};
  }
};
struct SphereProbe {
  Eigen::Vector3f centre;
  float radius;
  explicit SphereProbe(const Shape& s)
      : centre(s.point.cast<float>()), radius(static_cast<float>(s.radius)) {}
  Residual operator()(const Eigen::Vector3f& p, const Eigen::Vector3f& n) const {
    const Eigen::Vector3f out = p - centre;
    const float length = out.norm();
    return {std::abs(length - radius), std::abs(out.dot(n)) / length};
  }
};
struct CylinderProbe {
  Eigen::Vector3f point;
  Eigen::Vector3f axis;
  float radius;
  explicit CylinderProbe(const Shape& s)
      : point(s.point.cast<float>()),
        axis(s.axis.cast<float>()),
        radius(static_cast<float>(s.radius)) {}
  Residual operator()(const Eigen::Vector3f& p, const Eigen::Vector3f& n) const {
    const Eigen::Vector3f q = p - point;
    const Eigen::Vector3f out = q - q.dot(axis) * axis;
    const float length = out.norm();
    return {std::abs(length - radius), std::abs(out.dot(n)) / length};
  }
};
struct ConeProbe {
  Eigen::Vector3f apex;
  Eigen::Vector3f axis;
  float sine;
  float cosine;
  explicit ConeProbe(const Shape& s)
      : apex(s.point.cast<float>()),
        axis(s.axis.cast<float>()),
        sine(static_cast<float>(std::sin(s.angle))),
        cosine(static_cast<float>(std::cos(s.angle))) {}
  Residual operator()(const Eigen::Vector3f& p, const Eigen::Vector3f& n) const {
    const Eigen::Vector3f q = p - apex;
    const float depth = q.dot(axis);
    const Eigen::Vector3f across = q - depth * axis;
    const float away = across.norm();
    // Behind the apex's own normals the apex itself is nearest.
    if (depth * cosine + away * sine < 0.0F) return {q.norm(), 1.0F};
    const Eigen::Vector3f normal =
        (away > 0.0F ? Eigen::Vector3f(across * (cosine / away)) : Eigen::Vector3f::Zero()) -
        sine * axis;
    return {std::abs(away * cosine - depth * sine), std::abs(normal.dot(n))};
  }
};

/// Calls body with the probe of the shape's kind.
template <class Body>
decltype(auto) with_probe(const Shape& shape, const Body& body) {
  switch (shape.kind) {
    case Kind::sphere:
      return body(SphereProbe(shape));
    case Kind::cylinder:
      return body(CylinderProbe(shape));
    case Kind::cone:
      return body(ConeProbe(shape));
    default:
      return body(PlaneProbe(shape));
  }
}

}  // namespace velum::shapes
