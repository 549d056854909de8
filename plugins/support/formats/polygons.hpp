// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "formats/assemble.hpp"
#include "velum/mesh.hpp"

namespace velum::formats {

/// Triangles gathered from the polygons of a file.
struct Polygons {
  std::vector<std::int32_t> corners;  ///< three a triangle
  Index skipped = 0;                  ///< polygons with fewer than three corners

  /// Adds a polygon as a fan around its first corner; false when a corner is not in [0, vertices).
  [[nodiscard]] bool add(std::span<const std::int64_t> polygon, Index vertices);
  void append(const Polygons& other);
};

/// A mesh of the vertices and polygons of a file; tells how many polygons were skipped.
Mesh make_mesh(const Source& source, Cloud vertices, const Polygons& polygons,
               const ReadOptions& options, Context& context);

}  // namespace velum::formats
