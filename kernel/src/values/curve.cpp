// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "values/curve.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace velum::spatial {
namespace {

/// Bits of a cell's number along each axis. Three times this is sorted in three passes.
constexpr unsigned kBits = 10;
/// Shorter ranges are sorted by comparison.
constexpr std::size_t kShort = 512;

/// Key in the upper half, index of the point in the lower.
using Keyed = std::uint64_t;

std::uint32_t key_of(Keyed keyed) {
  return static_cast<std::uint32_t>(keyed >> 32U);
}

/// Every third bit, from bit 0 on.
std::uint32_t spread(std::uint32_t bits) {
  bits = (bits | bits << 16U) & 0x030000ffU;
  bits = (bits | bits << 8U) & 0x0300f00fU;
  bits = (bits | bits << 4U) & 0x030c30c3U;
  return (bits | bits << 2U) & 0x09249249U;
}

/// Place of a cell on the Hilbert curve (Skilling, Programming the Hilbert curve, AIP Conf. Proc.
/// 707, 2004): undo the turns of the curve from coarse to fine, then Gray-decode.
std::uint32_t hilbert(std::array<std::uint32_t, 3> cell) {
  for (std::uint32_t bit = 1U << (kBits - 1); bit > 1; bit >>= 1U) {
    const std::uint32_t below = bit - 1;
    for (std::uint32_t& axis : cell) {
      // Without branches, which the processor could not foresee: turned is all ones or zero.
      const std::uint32_t turned = (axis & bit) != 0 ? below : 0U;
      const std::uint32_t swapped = (cell[0] ^ axis) & below & ~turned;
      axis ^= swapped;
      cell[0] ^= swapped ^ turned;
    }
  }
  cell[1] ^= cell[0];
  cell[2] ^= cell[1];
  std::uint32_t gray = 0;
  for (std::uint32_t bit = 1U << (kBits - 1); bit > 1; bit >>= 1U)
    gray ^= (cell[2] & bit) != 0 ? bit - 1 : 0U;
  for (std::uint32_t& axis : cell) axis ^= gray;
  return spread(cell[0]) << 2U | spread(cell[1]) << 1U | spread(cell[2]);
}

/// Sorts by the upper half, stably.
void radix_sort(std::vector<Keyed>& values, std::vector<Keyed>& scratch) {
  constexpr std::size_t kDigits = std::size_t{1} << kBits;
  const auto digit = [](Keyed value, unsigned pass) {
    return static_cast<std::size_t>(value >> (32U + pass * kBits)) & (kDigits - 1);
  };
  std::array<std::array<std::uint32_t, kDigits>, 3> places = {};
  for (const Keyed value : values)
    for (unsigned pass = 0; pass < 3; ++pass) ++places[pass][digit(value, pass)];
  scratch.resize(values.size());
  for (unsigned pass = 0; pass < 3; ++pass) {
    std::uint32_t sum = 0;
    for (std::uint32_t& place : places[pass]) sum += std::exchange(place, sum);
    for (const Keyed value : values) scratch[places[pass][digit(value, pass)]++] = value;
    values.swap(scratch);
  }
}

class Sorter {
 public:
  Sorter(const ConstPoints& positions, std::size_t run) : positions_(positions), run_(run) {}

  /// Orders `indices`, which ascend, along a curve through their bounding box. Returns the parts
  /// that share a cell and are longer than a run.
  std::vector<std::span<std::int32_t>> order(std::span<std::int32_t> indices) {
    std::vector<std::span<std::int32_t>> crowded;
    if (!number(indices)) return crowded;
    if (indices.size() < kShort) {
      std::sort(keyed_.begin(), keyed_.end());
    } else {
      radix_sort(keyed_, scratch_);
    }
    std::size_t begin = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) {
      indices[i] = static_cast<std::int32_t>(keyed_[i] & 0xffffffffU);
      if (i + 1 < indices.size() && key_of(keyed_[i + 1]) == key_of(keyed_[i])) continue;
      if (i + 1 - begin > run_) crowded.push_back(indices.subspan(begin, i + 1 - begin));
      begin = i + 1;
    }
    return crowded;
  }

 private:
  /// Fills keyed_; false when all points are equal.
  bool number(std::span<const std::int32_t> indices) {
    Eigen::AlignedBox3d box;
    for (const std::int32_t i : indices) box.extend(positions_.col(i).cast<double>());
    const double extent = box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
    if (!(extent > 0.0)) return false;
    // In double: extents may be denormal or overflow in single precision.
    constexpr double kCells = 1U << kBits;
    const double scale = kCells / extent;
    const auto cell = [&](std::int32_t i, Index axis) {
      const double x = (static_cast<double>(positions_(axis, i)) - box.min()(axis)) * scale;
      return static_cast<std::uint32_t>(std::min(x, kCells - 1.0));
    };
    keyed_.resize(indices.size());
    for (std::size_t n = 0; n < indices.size(); ++n) {
      const std::int32_t i = indices[n];
      const Keyed key = hilbert({cell(i, 0), cell(i, 1), cell(i, 2)});
      keyed_[n] = key << 32U | static_cast<std::uint32_t>(i);
    }
    return true;
  }

  ConstPoints positions_;
  std::size_t run_;
  std::vector<Keyed> keyed_;
  std::vector<Keyed> scratch_;
};

}  // namespace

std::vector<std::int32_t> curve_order(const ConstPoints& positions, std::size_t run) {
  std::vector<std::int32_t> indices(static_cast<std::size_t>(positions.cols()));
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::int32_t>(i);
  Sorter sorter(positions, run);
  // Each finer curve has cells 1024 times smaller, so that this ends.
  std::vector<std::span<std::int32_t>> crowded = {indices};
  while (!crowded.empty()) {
    const auto range = crowded.back();
    crowded.pop_back();
    const auto finer = sorter.order(range);
    crowded.insert(crowded.end(), finer.begin(), finer.end());
  }
  return indices;
}

}  // namespace velum::spatial
