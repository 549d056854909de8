// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/polygons.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace velum::formats {

bool Polygons::add(std::span<const std::int64_t> polygon, Index vertices) {
  for (const std::int64_t corner : polygon)
    if (corner < 0 || corner >= vertices) return false;
  if (polygon.size() < 3) ++skipped;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    corners.push_back(static_cast<std::int32_t>(polygon[0]));
    corners.push_back(static_cast<std::int32_t>(polygon[i - 1]));
    corners.push_back(static_cast<std::int32_t>(polygon[i]));
  }
  return true;
}

void Polygons::append(const Polygons& other) {
  corners.insert(corners.end(), other.corners.begin(), other.corners.end());
  skipped += other.skipped;
}

Mesh make_mesh(const Source& source, Cloud vertices, const Polygons& polygons,
               const ReadOptions& options, Context& context) {
  if (polygons.skipped > 0)
    context.warn(fmt::format("{}: {} polygons with fewer than three corners were left out",
                             source.name(), polygons.skipped));
  const auto count = static_cast<Index>(polygons.corners.size() / 3);
  Triangles triangles = ConstTriangles(polygons.corners.data(), 3, count);
  // A mirrored surface would show its back.
  if (options.left_handed) triangles.row(1).swap(triangles.row(2));
  return {std::move(vertices), std::move(triangles)};
}

}  // namespace velum::formats
