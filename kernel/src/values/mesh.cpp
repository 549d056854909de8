// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "velum/mesh.hpp"

#include <fmt/format.h>

namespace velum {

Mesh::Mesh() : triangles_(Triangles(3, 0)) {}

Mesh::Mesh(Cloud vertices, Triangles triangles) : vertices_(std::move(vertices)) {
  if (triangles.size() > 0) {
    const Index low = triangles.minCoeff();
    const Index high = triangles.maxCoeff();
    if (low < 0 || high >= vertices_.size())
      throw Error(Fault::stage,
                  fmt::format("a triangle names vertex {}, but the mesh has {} vertices",
                              low < 0 ? low : high, vertices_.size()));
  }
  triangles_ = Column(std::move(triangles));
}

ConstTriangles Mesh::triangles() const {
  const auto matrix = triangles_.as<std::int32_t>();
  return {matrix.data(), 3, matrix.cols()};
}

Mesh Mesh::with_vertices(Cloud vertices) const {
  if (vertices.size() != vertices_.size())
    throw Error(Fault::stage, fmt::format("{} vertices in place of the mesh's {}", vertices.size(),
                                          vertices_.size()));
  Mesh result(*this);
  result.vertices_ = std::move(vertices);
  return result;
}

}  // namespace velum
