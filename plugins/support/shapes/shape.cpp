// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "shapes/shape.hpp"

namespace velum::shapes {

std::string_view name_of(Kind kind) {
  constexpr std::array<std::string_view, 4> kNames = {"plane", "sphere", "cylinder", "cone"};
  return kNames.at(static_cast<std::size_t>(kind));
}

double Shape::distance(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d q = p - point;
  const double along = q.dot(axis);
  switch (kind) {
    case Kind::sphere:
      return q.norm() - radius;
    case Kind::cylinder:
      return (q - along * axis).norm() - radius;
    case Kind::cone: {
      const double away = (q - along * axis).norm();
      if (along * std::cos(angle) + away * std::sin(angle) < 0.0) return q.norm();
      return away * std::cos(angle) - along * std::sin(angle);
    }
    default:
      return along;
  }
}

}  // namespace velum::shapes
