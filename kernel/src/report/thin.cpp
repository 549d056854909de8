// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Views with fewer points: every second one of a cloud, vertices merged on a grid for a mesh. And
// tables with fewer rows.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>
#include <unordered_map>

#include "report/views.hpp"

namespace velum::report {
namespace {

/// Fewer are never worth it.
constexpr std::uint64_t kFewest = 256;
/// A mesh is merged until this share of its vertices is left.
constexpr double kShare = 0.6;
/// Cells of the finest grid along the longest side of the box.
constexpr double kFinest = 2048.0;

/// Elements of `size` bytes at `indices`.
Bytes select(const Bytes& from, std::size_t size, const std::vector<std::uint32_t>& indices) {
  std::vector<std::byte> to(indices.size() * size);
  for (std::size_t i = 0; i < indices.size(); ++i)
    std::memcpy(&to[i * size], &from.bytes()[indices[i] * size], size);
  return Bytes(std::move(to));
}

View select(const View& view, const std::vector<std::uint32_t>& indices) {
  View made = view;
  ++made.thinned;
  made.shown = indices.size();
  made.positions = select(view.positions, 3 * sizeof(std::uint16_t), indices);
  for (ViewColumn& column : made.columns)
    column.data = select(column.data, static_cast<std::size_t>(column.bits) / 8, indices);
  return made;
}

/// The first vertex of each cell of the grid, and by vertex the place of its cell's in `kept`.
struct Merged {
  std::vector<std::uint32_t> kept;
  std::vector<std::uint32_t> place;
};

Merged merge(const View& view, double cell) {
  const auto steps = view.positions.as<std::uint16_t>();
  const Eigen::Vector3d scale = (view.hi - view.lo) / (kPositionSteps * cell);
  Merged merged;
  merged.place.reserve(view.shown);
  std::unordered_map<std::uint64_t, std::uint32_t> cells;
  for (std::size_t i = 0; i < view.shown; ++i) {
    std::uint64_t key = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      constexpr unsigned kBits = 21;
      const double at = steps[3 * i + axis] * scale[static_cast<Index>(axis)];
      key = key << kBits | static_cast<std::uint64_t>(at);
    }
    const auto [found, fresh] = cells.emplace(key, static_cast<std::uint32_t>(merged.kept.size()));
    if (fresh) merged.kept.push_back(static_cast<std::uint32_t>(i));
    merged.place.push_back(found->second);
  }
  return merged;
}

/// Triangles whose corners are still three, each once, in their order.
std::vector<std::uint32_t> triangles_of(const View& view, const std::vector<std::uint32_t>& place) {
  const std::vector<std::uint32_t> old = indices_of(view);
  std::vector<std::uint32_t> made;
  std::set<std::array<std::uint32_t, 3>> known;
  for (std::size_t t = 0; t + 2 < old.size(); t += 3) {
    std::array<std::uint32_t, 3> corner = {place[old[t]], place[old[t + 1]], place[old[t + 2]]};
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
    // From its lowest corner on, which keeps its orientation.
    std::rotate(corner.begin(), std::ranges::min_element(corner), corner.end());
    if (known.insert(corner).second) made.insert(made.end(), corner.begin(), corner.end());
  }
  return made;
}

std::size_t rows_of(const View& view) {
  return view.rows.is_null() ? 0 : view.rows.at("rows").size();
}

void halve_rows(View& view) {
  run::Json kept = run::Json::array();
  run::Json& rows = view.rows.at("rows");
  for (std::size_t i = 0; i < rows.size(); i += 2) kept.push_back(std::move(rows[i]));
  rows = std::move(kept);
  if (view.type == ValueType::table) view.shown = rows.size();
}

std::optional<View> thinner_mesh(const View& view) {
  const double side = (view.hi - view.lo).maxCoeff();
  if (!(side > 0.0)) return std::nullopt;
  double cell = view.cell > 0.0 ? view.cell : side / kFinest;
  Merged merged;
  do {
    cell *= std::sqrt(2.0);
    merged = merge(view, cell);
  } while (static_cast<double>(merged.kept.size()) > kShare * static_cast<double>(view.shown));
  if (merged.kept.size() < kFewest / 2) return std::nullopt;
  View made = select(view, merged.kept);
  made.cell = cell;
  set_triangles(made, triangles_of(view, merged.place));
  return made;
}

}  // namespace

std::optional<View> thinner(const View& view) {
  if (view.shown < kFewest || !view.positions.there()) return std::nullopt;
  if (view.triangles.there()) return thinner_mesh(view);
  std::vector<std::uint32_t> indices;
  for (std::uint64_t i = 0; i < view.shown; i += 2)
    indices.push_back(static_cast<std::uint32_t>(i));
  return select(view, indices);
}

void limit_tables(std::vector<View>& views, std::size_t cells) {
  const auto total = [&] {
    std::size_t sum = 0;
    for (const View& view : views)
      if (rows_of(view) > 0) sum += rows_of(view) * view.rows.at("columns").size();
    return sum;
  };
  while (total() > cells) {
    View& longest = *std::ranges::max_element(views, {}, rows_of);
    if (rows_of(longest) < 2) return;
    halve_rows(longest);
  }
}

}  // namespace velum::report
