// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/along_curve.hpp"

#include <algorithm>

namespace velum::registration {
namespace {

/// Bits of a cell's number along each axis.
constexpr double kCells = 1024.0;

/// Every third bit, from bit 0 on, of ten.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 16U) & 0x030000ffU;
  bits = (bits | bits << 8U) & 0x0300f00fU;
  bits = (bits | bits << 4U) & 0x030c30c3U;
  return (bits | bits << 2U) & 0x09249249U;
}

}  // namespace

std::vector<std::int32_t> along_curve(const Eigen::Ref<const Points>& positions) {
  const Index n = positions.cols();
  Eigen::AlignedBox3d box;
  for (Index i = 0; i < n; ++i) box.extend(positions.col(i).cast<double>());
  const double extent = n > 0 ? box.sizes().maxCoeff() : 0.0;
  const double scale = extent > 0.0 ? kCells / extent : 0.0;
  std::vector<std::uint64_t> keyed(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) {
    std::uint64_t key = 0;
    for (Index axis = 0; axis < 3; ++axis) {
      const double x = (static_cast<double>(positions(axis, i)) - box.min()(axis)) * scale;
      key |= spread(static_cast<std::uint64_t>(std::min(x, kCells - 1.0))) << axis;
    }
    keyed[static_cast<std::size_t>(i)] = key << 32U | static_cast<std::uint64_t>(i);
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::int32_t> order(keyed.size());
  std::transform(keyed.begin(), keyed.end(), order.begin(), [](std::uint64_t value) {
    return static_cast<std::int32_t>(value & 0xffffffffU);
  });
  return order;
}

}  // namespace velum::registration
