// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "spread.hpp"

#include <cmath>
#include <unordered_map>

namespace velum::upsample {
namespace {

using Cell = Eigen::Array<std::int64_t, 3, 1>;

// A number for each cell. Cells may share one: distances decide in the end.
std::uint64_t key(const Cell& cell) {
  std::uint64_t mixed = 0;
  for (const std::int64_t index : cell)
    mixed = (mixed ^ static_cast<std::uint64_t>(index)) * 0x9e3779b97f4a7c15U;
  return mixed ^ (mixed >> 29U);
}

}  // namespace

std::vector<Candidate> spread(const std::vector<Candidate>& places, double apart,
                              Context& context) {
  std::vector<Candidate> chosen;
  std::unordered_multimap<std::uint64_t, std::size_t> by_cell;
  const auto has_room = [&](const Cell& cell, const Eigen::Vector3f& at) {
    for (std::int64_t i = 0; i < 27; ++i) {
      const Cell beside = cell + Cell(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      const auto [begin, end] = by_cell.equal_range(key(beside));
      for (auto other = begin; other != end; ++other)
        if (static_cast<double>((chosen[other->second].at - at).norm()) < apart) return false;
    }
    return true;
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i % 4096 == 0) context.check();
    const Eigen::Vector3f& at = places[i].at;
    const Cell cell = (at.cast<double>().array() / apart).floor().cast<std::int64_t>();
    if (!has_room(cell, at)) continue;
    by_cell.emplace(key(cell), chosen.size());
    chosen.push_back(places[i]);
  }
  return chosen;
}

}  // namespace velum::upsample
