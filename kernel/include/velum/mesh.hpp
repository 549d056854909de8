// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "velum/cloud.hpp"

namespace velum {

/// Triangles over a cloud of vertices, whose columns are per-vertex values. Immutable, cheap to
/// copy.
class VELUM_API Mesh {
 public:
  Mesh();
  /// Throws Error (Fault::stage) when a triangle names a vertex that does not exist.
  Mesh(Cloud vertices, Triangles triangles);

  /// The vertices with their columns, origin and sensors.
  [[nodiscard]] const Cloud& vertices() const { return vertices_; }
  [[nodiscard]] ConstPoints positions() const { return vertices_.positions(); }
  [[nodiscard]] ConstTriangles triangles() const;
  [[nodiscard]] const Column& triangle_column() const { return triangles_; }
  [[nodiscard]] Index size() const { return triangles_.count(); }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] const Eigen::Vector3d& origin() const { return vertices_.origin(); }
  [[nodiscard]] const std::vector<Sensor>& sensors() const { return vertices_.sensors(); }

  /// The same triangles over other vertices of the same number.
  [[nodiscard]] Mesh with_vertices(Cloud vertices) const;

 private:
  Cloud vertices_;
  Column triangles_;
};

}  // namespace velum
