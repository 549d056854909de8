// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <velum/mesh.hpp>

namespace velum::mesh {

/// The point of triangle (a, b, c) nearest to `p` (Ericson, Real-Time Collision Detection, 5.1.5).
Eigen::Vector3d closest_on_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                    const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// Exact distances from points to a mesh, by a tree of boxes around its triangles. Queries are
/// const and thread-safe.
class DistanceTree {
 public:
  /// Keeps a copy of the triangles' corners; coordinates relative to the mesh's origin.
  explicit DistanceTree(const Mesh& mesh);
  ~DistanceTree();
  DistanceTree(const DistanceTree&) = delete;
  DistanceTree& operator=(const DistanceTree&) = delete;

  struct Hit {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    double distance2 = 0.0;      ///< squared [m²]
    std::int32_t triangle = -1;  ///< -1: the mesh has no triangle
  };
  [[nodiscard]] Hit closest(const Eigen::Vector3d& query) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace velum::mesh
