// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <type_traits>

namespace velum {

using Index = Eigen::Index;

/// 3×N single-precision positions [m] or directions, one point a column.
using Points = Eigen::Matrix3Xf;
/// Read-only view of a 3×N column.
using ConstPoints = Eigen::Map<const Eigen::Matrix3Xf>;
/// 3×M vertex indices of triangles, counter-clockwise seen from the side of the normal.
using Triangles = Eigen::Matrix<std::int32_t, 3, Eigen::Dynamic>;
using ConstTriangles = Eigen::Map<const Triangles>;
using VectorXu8 = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 1>;
/// A rigid motion in double precision.
using Pose = Eigen::Isometry3d;

namespace detail {
/// Position of T in a list of types.
template <class T, template <class...> class List, class... Types>
consteval int position(const List<Types...>*) {
  static_assert((std::is_same_v<T, Types> || ...), "not one of the types that Velum knows");
  int at = 0;
  (void)((std::is_same_v<T, Types> || (++at, false)) || ...);
  return at;
}
}  // namespace detail

}  // namespace velum
