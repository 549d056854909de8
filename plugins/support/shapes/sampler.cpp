// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "shapes/sampler.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace velum::shapes {
namespace {

constexpr int kBits = 20;  // of each coordinate

// Spreads the bits of x so that two zeros follow each.
std::uint64_t spread(std::uint64_t x) {
  x = (x | (x << 32U)) & 0x001f00000000ffffU;
  x = (x | (x << 16U)) & 0x001f0000ff0000ffU;
  x = (x | (x << 8U)) & 0x100f00f00f00f00fU;
  x = (x | (x << 4U)) & 0x10c30c30c30c30c3U;
  x = (x | (x << 2U)) & 0x1249249249249249U;
  return x;
}

}  // namespace

LocalSampler::LocalSampler(const Points& positions) {
  if (positions.cols() == 0) return;
  const Eigen::Vector3d low = positions.rowwise().minCoeff().cast<double>();
  const Eigen::Vector3d high = positions.rowwise().maxCoeff().cast<double>();
  const double extent = (high - low).maxCoeff();
  const double scale = extent > 0.0 ? ((1U << kBits) - 1) / extent : 0.0;
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys(
      static_cast<std::size_t>(positions.cols()));
  for (Index i = 0; i < positions.cols(); ++i) {
    const Eigen::Vector3d cell = (positions.col(i).cast<double>() - low) * scale;
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis)
      code |= spread(static_cast<std::uint64_t>(cell[axis])) << static_cast<unsigned>(axis);
    keys[static_cast<std::size_t>(i)] = {code, static_cast<std::int32_t>(i)};
  }
  std::sort(keys.begin(), keys.end());
  for (const auto& [code, point] : keys) {
    codes_.push_back(code);
    points_.push_back(point);
  }
  // A level divides the points of a surface by four.
  const double deepest = std::log2(static_cast<double>(positions.cols()) / 10.0) / 2.0;
  levels_ = std::clamp(static_cast<int>(deepest) + 1, 1, kBits);
}

std::optional<std::array<std::int32_t, 3>> LocalSampler::draw(Random& random, int level) const {
  const auto count = static_cast<std::int64_t>(points_.size());
  if (count < 3) return std::nullopt;
  const std::int64_t first = random.below(count);
  const auto shift = static_cast<unsigned>(3 * (kBits - level));
  const std::uint64_t cell = codes_[static_cast<std::size_t>(first)] >> shift;
  const auto begin =
      std::lower_bound(codes_.begin(), codes_.end(), cell,
                       [&](std::uint64_t code, std::uint64_t c) { return (code >> shift) < c; });
  const auto end =
      std::upper_bound(begin, codes_.end(), cell,
                       [&](std::uint64_t c, std::uint64_t code) { return c < (code >> shift); });
  const std::int64_t from = begin - codes_.begin();
  const std::int64_t size = end - begin;
  if (size < 3) return std::nullopt;
  const std::int64_t second = from + random.below(size);
  const std::int64_t third = from + random.below(size);
  if (first == second || first == third || second == third) return std::nullopt;
  return std::array{points_[static_cast<std::size_t>(first)],
                    points_[static_cast<std::size_t>(second)],
                    points_[static_cast<std::size_t>(third)]};
}

void LocalSampler::remove(const Eigen::VectorXi& labels) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (labels[points_[i]] >= 0) continue;
    points_[kept] = points_[i];
    codes_[kept++] = codes_[i];
  }
  points_.resize(kept);
  codes_.resize(kept);
}

}  // namespace velum::shapes
