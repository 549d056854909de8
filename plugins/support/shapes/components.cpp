// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "shapes/components.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <unordered_map>
#include <velum/error.hpp>

namespace velum::shapes {
namespace {

using Key = std::uint64_t;

constexpr unsigned kBits = 21;  // of each coordinate of a cell in its key

struct Cells {
  std::vector<std::int32_t> points;  ///< cell by cell
  std::vector<std::int32_t> starts;  ///< of each cell in points, and the end
  std::vector<std::array<std::int64_t, 3>> places;
  [[nodiscard]] std::size_t size() const { return places.size(); }
  [[nodiscard]] std::span<const std::int32_t> of(std::size_t cell) const {
    const auto begin = static_cast<std::size_t>(starts[cell]);
    return {points.data() + begin, static_cast<std::size_t>(starts[cell + 1]) - begin};
  }
};

// A key that tells cells within the reach of the neighbour search apart; cells whole periods away
// may share it, so that places are compared as well.
Key key_of(const std::array<std::int64_t, 3>& place) {
  constexpr Key kMask = (Key{1} << kBits) - 1;
  return (static_cast<Key>(place[0]) & kMask) | (static_cast<Key>(place[1]) & kMask) << kBits |
         (static_cast<Key>(place[2]) & kMask) << (2 * kBits);
}

Cells sorted_cells(const ConstPoints& positions, double side) {
  const Eigen::Vector3d low = positions.rowwise().minCoeff().cast<double>();
  struct Entry {
    std::array<std::int64_t, 3> place;
    std::int32_t point;
    bool operator<(const Entry& other) const {
      return place != other.place ? place < other.place : point < other.point;
    }
  };
  std::vector<Entry> entries(static_cast<std::size_t>(positions.cols()));
  for (Index i = 0; i < positions.cols(); ++i) {
    Entry& entry = entries[static_cast<std::size_t>(i)];
    entry.point = static_cast<std::int32_t>(i);
    for (int axis = 0; axis < 3; ++axis)
      entry.place[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(
          std::floor((static_cast<double>(positions(axis, i)) - low[axis]) / side));
  }
  std::sort(entries.begin(), entries.end());
  Cells cells;
  for (const Entry& entry : entries) {
    if (cells.places.empty() || cells.places.back() != entry.place) {
      cells.starts.push_back(static_cast<std::int32_t>(cells.points.size()));
      cells.places.push_back(entry.place);
    }
    cells.points.push_back(entry.point);
  }
  cells.starts.push_back(static_cast<std::int32_t>(cells.points.size()));
  return cells;
}

// Half of the 5³ cells around one that can hold points within the radius: the others see it.
std::vector<std::array<std::int64_t, 3>> steps() {
  std::vector<std::array<std::int64_t, 3>> made;
  for (std::int64_t x = -2; x <= 2; ++x)
    for (std::int64_t y = -2; y <= 2; ++y)
      for (std::int64_t z = -2; z <= 2; ++z)
        if (std::array<std::int64_t, 3>{x, y, z} > std::array<std::int64_t, 3>{0, 0, 0})
          made.push_back({x, y, z});
  return made;
}

bool touch(const ConstPoints& positions, std::span<const std::int32_t> a,
           std::span<const std::int32_t> b, double radius2) {
  return std::any_of(a.begin(), a.end(), [&](std::int32_t i) {
    const Eigen::Vector3d p = positions.col(i).cast<double>();
    return std::any_of(b.begin(), b.end(), [&](std::int32_t j) {
      return (positions.col(j).cast<double>() - p).squaredNorm() <= radius2;
    });
  });
}

class Union {
 public:
  explicit Union(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

Pairs touching(const ConstPoints& positions, const Cells& cells, double radius, Context& context) {
  std::unordered_multimap<Key, std::size_t> by_key;
  by_key.reserve(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) by_key.emplace(key_of(cells.places[c]), c);
  const auto around = steps();
  const auto look = [&](std::size_t cell, Pairs& pairs) {
    for (const auto& step : around) {
      auto place = cells.places[cell];
      for (std::size_t axis = 0; axis < 3; ++axis) place[axis] += step[axis];
      const auto [begin, end] = by_key.equal_range(key_of(place));
      for (auto other = begin; other != end; ++other)
        if (cells.places[other->second] == place &&
            touch(positions, cells.of(cell), cells.of(other->second), radius * radius))
          pairs.emplace_back(cell, other->second);
    }
  };
  return parallel_reduce(
      context, static_cast<Index>(cells.size()), 256, Pairs{},
      [&](Index begin, Index end) {
        Pairs part;
        for (Index c = begin; c < end; ++c) look(static_cast<std::size_t>(c), part);
        return part;
      },
      [](Pairs& all, const Pairs& part) { all.insert(all.end(), part.begin(), part.end()); });
}

}  // namespace

Components components(const ConstPoints& positions, double radius, Context& context) {
  Components made;
  made.labels = Eigen::VectorXi::Constant(positions.cols(), -1);
  if (positions.cols() == 0) return made;
  const double extent = static_cast<double>(
      (positions.rowwise().maxCoeff() - positions.rowwise().minCoeff()).maxCoeff());
  if (!(radius > 1e-9 * extent))
    throw Error(Fault::stage,
                fmt::format("a radius of {} m is nothing beside an extent of {} m", radius, extent))
        .hint("a few times the points' spacing is usual");
  context.check();
  // A little under the exact side, so that rounding never joins what is too far.
  const Cells cells = sorted_cells(positions, radius / std::sqrt(3.0) * (1.0 - 1e-9));
  context.check();
  Union sets(cells.size());
  for (const auto& [a, b] : touching(positions, cells, radius, context)) sets.join(a, b);

  std::vector<Index> count(cells.size(), 0);
  std::vector<std::int32_t> first(cells.size(), std::numeric_limits<std::int32_t>::max());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::size_t root = sets.root(c);
    count[root] += static_cast<Index>(cells.of(c).size());
    first[root] = std::min(first[root], cells.of(c).front());
  }
  std::vector<std::size_t> roots;
  for (std::size_t c = 0; c < cells.size(); ++c)
    if (count[c] > 0) roots.push_back(c);
  std::sort(roots.begin(), roots.end(), [&](std::size_t a, std::size_t b) {
    return count[a] != count[b] ? count[a] > count[b] : first[a] < first[b];
  });
  std::vector<int> number(cells.size(), -1);
  for (std::size_t k = 0; k < roots.size(); ++k) {
    number[roots[k]] = static_cast<int>(k);
    made.sizes.push_back(count[roots[k]]);
  }
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (const std::int32_t p : cells.of(c)) made.labels[p] = number[sets.root(c)];
  return made;
}

std::vector<std::int32_t> largest_part(const Points& positions,
                                       const std::vector<std::int32_t>& members, double radius,
                                       Context& context) {
  Points part(3, static_cast<Index>(members.size()));
  for (Index i = 0; i < part.cols(); ++i)
    part.col(i) = positions.col(members[static_cast<std::size_t>(i)]);
  const Components parts = components(ConstPoints(part.data(), 3, part.cols()), radius, context);
  std::vector<std::int32_t> kept;
  for (std::size_t i = 0; i < members.size(); ++i)
    if (parts.labels[static_cast<Index>(i)] == 0) kept.push_back(members[i]);
  return kept;
}

}  // namespace velum::shapes
