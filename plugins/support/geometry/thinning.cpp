// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "geometry/thinning.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace velum::geometry {
namespace {

constexpr int kBits = 21;

class Grid {
 public:
  Grid(const Eigen::AlignedBox3f& box, double cell)
      : low_(box.min().cast<double>()), scale_(1.0 / cell) {}
  [[nodiscard]] std::uint64_t operator()(const Eigen::Vector3f& point) const {
    const Eigen::Vector3d at = (point.cast<double>() - low_) * scale_;
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis)
      key = (key << kBits) | static_cast<std::uint64_t>(std::max(0.0, at[axis]));
    return key;
  }

 private:
  Eigen::Vector3d low_;
  double scale_;
};

/// How many cells hold a point: a table with open addressing, several times faster than sorting.
Index count_occupied(const ConstPoints& positions, const Grid& grid) {
  const std::size_t size = std::bit_ceil(static_cast<std::size_t>(positions.cols()) * 2 + 2);
  constexpr std::uint64_t kFree = ~std::uint64_t{0};
  std::vector<std::uint64_t> table(size, kFree);
  Index occupied = 0;
  for (Index i = 0; i < positions.cols(); ++i) {
    const std::uint64_t key = grid(positions.col(i));
    std::size_t at = (key * 0x9e3779b97f4a7c15U) >> 20U;
    while (table[at & (size - 1)] != key && table[at & (size - 1)] != kFree) ++at;
    if (table[at & (size - 1)] == key) continue;
    table[at & (size - 1)] = key;
    ++occupied;
  }
  return occupied;
}

/// Points by the number of their cell, ascending.
std::vector<std::pair<std::uint64_t, std::int32_t>> sorted_cells(const ConstPoints& positions,
                                                                 const Grid& grid) {
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys;
  keys.reserve(static_cast<std::size_t>(positions.cols()));
  for (Index i = 0; i < positions.cols(); ++i)
    keys.emplace_back(grid(positions.col(i)), static_cast<std::int32_t>(i));
  std::sort(keys.begin(), keys.end());
  return keys;
}

}  // namespace

Thinned thin(const ConstPoints& positions, double cell) {
  const Eigen::AlignedBox3f box = bounding_box(positions);
  Thinned thinned;
  const Index n = positions.cols();
  if (n == 0) return thinned;
  const double extent = static_cast<double>(box.sizes().maxCoeff());
  thinned.cell = std::max({cell, extent / ((1 << kBits) - 2), 1e-30});
  const auto keys = sorted_cells(positions, Grid(box, thinned.cell));
  thinned.cell_of.resize(static_cast<std::size_t>(n));
  std::vector<Eigen::Vector3d> sums;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (k == 0 || keys[k].first != keys[k - 1].first) {
      sums.emplace_back(Eigen::Vector3d::Zero());
      thinned.counts.push_back(0);
    }
    sums.back() += (positions.col(keys[k].second) - box.min()).cast<double>();
    ++thinned.counts.back();
    thinned.cell_of[static_cast<std::size_t>(keys[k].second)] =
        static_cast<std::int32_t>(sums.size()) - 1;
  }
  thinned.means.resize(3, static_cast<Index>(sums.size()));
  for (std::size_t c = 0; c < sums.size(); ++c)
    thinned.means.col(static_cast<Index>(c)) =
        (sums[c] / thinned.counts[c] + box.min().cast<double>()).cast<float>();
  return thinned;
}

double cell_for(const ConstPoints& positions, Index wanted) {
  const Eigen::AlignedBox3f box = bounding_box(positions);
  if (positions.cols() < 2 || !(box.diagonal().norm() > 0.0F)) return 0.0;
  double cell = static_cast<double>(box.diagonal().norm()) / 100.0;
  // Cells of a surface go with 1/cell²; a few far points may have spoiled the first guess.
  for (int round = 0; round < 3; ++round) {
    const Index occupied = count_occupied(positions, Grid(box, cell));
    const double ratio = std::sqrt(static_cast<double>(occupied) / static_cast<double>(wanted));
    cell *= std::clamp(ratio, 0.1, 10.0);
    if (std::abs(ratio - 1.0) < 0.1) break;
  }
  return cell;
}

}  // namespace velum::geometry
