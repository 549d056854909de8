// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/range_image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace velum::registration {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kFinest = 192;  ///< pixels along the edge of a face: about 0.5°
constexpr int kCoarsest = 12;
/// Points that an occupied pixel should hold on average, so that no gap between beams looks free.
constexpr double kFull = 3.0;
/// Of the nine pixels around a direction, how many must be looked at before it counts as seen.
constexpr int kSeen = 6;
/// Ranges differ within a pixel where a surface is seen at a grazing angle.
constexpr float kSlope = 0.02F;

struct Pixel {
  int face;
  int u;
  int v;
};

Pixel pixel_of(const Eigen::Vector3f& way, int side) {
  int axis = 0;
  way.cwiseAbs().maxCoeff(&axis);
  const float scale = 1.0F / std::max(std::abs(way[axis]), 1e-30F);
  const auto cell = [&](float x) {
    return std::clamp(static_cast<int>((x * scale + 1.0F) * 0.5F * static_cast<float>(side)), 0,
                      side - 1);
  };
  return {2 * axis + (way[axis] < 0.0F ? 1 : 0), cell(way[(axis + 1) % 3]),
          cell(way[(axis + 2) % 3])};
}

}  // namespace

RangeImage::RangeImage(const Eigen::Matrix3Xf& points, const std::vector<char>& is_rest) {
  for (side_ = kFinest; side_ >= kCoarsest; side_ /= 2)
    if (fill(points, is_rest)) return;
  side_ = kCoarsest;
}

bool RangeImage::fill(const Eigen::Matrix3Xf& points, const std::vector<char>& is_rest) {
  const auto pixels = static_cast<std::size_t>(6 * side_ * side_);
  nearest_.assign(pixels, kInfinity);
  nearest_rest_.assign(pixels, kInfinity);
  farthest_rest_.assign(pixels, -kInfinity);
  for (Index i = 0; i < points.cols(); ++i) {
    const Pixel p = pixel_of(points.col(i), side_);
    const auto at = static_cast<std::size_t>((p.face * side_ + p.v) * side_ + p.u);
    const float range = points.col(i).norm();
    nearest_[at] = std::min(nearest_[at], range);
    if (is_rest[static_cast<std::size_t>(i)] == 0) continue;
    nearest_rest_[at] = std::min(nearest_rest_[at], range);
    farthest_rest_[at] = std::max(farthest_rest_[at], range);
  }
  const auto occupied = std::count_if(nearest_.begin(), nearest_.end(),
                                      [](float range) { return range < kInfinity; });
  return static_cast<double>(points.cols()) >= kFull * static_cast<double>(occupied);
}

RangeImage::Sight RangeImage::look(const Eigen::Vector3f& point, float margin) const {
  const Pixel p = pixel_of(point, side_);
  const float range = point.norm();
  const float room = margin + kSlope * range;
  float nearest = kInfinity;
  int seen = 0;
  for (int v = std::max(0, p.v - 1); v <= std::min(side_ - 1, p.v + 1); ++v)
    for (int u = std::max(0, p.u - 1); u <= std::min(side_ - 1, p.u + 1); ++u) {
      const auto at = static_cast<std::size_t>((p.face * side_ + v) * side_ + u);
      if (nearest_[at] == kInfinity) continue;
      ++seen;
      nearest = std::min(nearest, nearest_[at]);
      if (std::abs(range - nearest_rest_[at]) < margin ||
          std::abs(range - farthest_rest_[at]) < margin)
        return Sight::agrees;
    }
  return seen >= kSeen && range < nearest - room ? Sight::blocked : Sight::unknown;
}

}  // namespace velum::registration
