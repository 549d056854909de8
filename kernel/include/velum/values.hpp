// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <variant>

#include "velum/cloud.hpp"
#include "velum/mesh.hpp"
#include "velum/table.hpp"

namespace velum {

/// A rigid motion from the frame `source` to the frame `target`, acting on true positions.
struct Transform {
  Pose matrix = Pose::Identity();
  std::string source = "source";
  std::string target = "target";
  /// How well the clouds agree [m²], mean squared distance of the pairs; negative when unknown.
  double fitness = -1.0;
  /// One row an iteration; empty when the method has none.
  Table history;
};

/// Tensor-product B-spline or NURBS. Control point (i, j), i along u, is column i·count_v + j of
/// `control` [m, relative to origin]; `weights` is empty for a B-spline.
struct Surface {
  int degree_u = 3;
  int degree_v = 3;
  Eigen::VectorXd knots_u;
  Eigen::VectorXd knots_v;
  Eigen::Matrix3Xd control;
  Eigen::VectorXd weights;
  /// Closed loops in (u, v), 2×n each; the first is the outer border. Empty: untrimmed.
  std::vector<Eigen::Matrix2Xd> trimming;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<Sensor> sensors;
};

/// A partition of (part of) a cloud. `labels` has one entry a point, -1 for none; `kinds` has one
/// row a cluster, by number, with at least the columns `cluster` and `points`.
struct Clusters {
  Cloud cloud;
  Column labels{Eigen::VectorXi()};
  Table kinds;

  [[nodiscard]] Eigen::Map<const Eigen::VectorXi> label() const { return labels.vector<int>(); }
};

/// Pairs of points of two clouds with their distances [m].
struct Correspondences {
  Column source{Eigen::VectorXi()};
  Column target{Eigen::VectorXi()};
  Column distance{Eigen::VectorXf()};
};

/// What flows from node to node.
using Value = std::variant<Cloud, Mesh, Surface, Transform, Clusters, Correspondences, Table>;
/// Position of each type in Value.
enum class ValueType : std::uint8_t {
  cloud,
  mesh,
  surface,
  transform,
  clusters,
  correspondences,
  table
};

template <class T>
inline constexpr ValueType kValueType =
    static_cast<ValueType>(detail::position<T>(static_cast<Value*>(nullptr)));

inline ValueType type_of(const Value& value) {
  return static_cast<ValueType>(value.index());
}
/// "cloud", "mesh", ...
VELUM_API std::string_view name_of(ValueType type);
/// Nothing in it: no points, no triangles, no clusters. Tables and transforms are never empty.
VELUM_API bool is_empty(const Value& value);
/// XXH3-128 of the content in lower-case hexadecimal; equal for equal values.
VELUM_API std::string hash_of(const Value& value);

}  // namespace velum
