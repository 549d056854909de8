// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

/// Colours of glTF are linear in light, those of clouds are sRGB (IEC 61966-2-1). Sixteen linear
/// bits hold all 256 levels of sRGB, so that a colour comes back as it was.
namespace velum::formats {

/// 0 to 65535.
inline std::uint16_t linear_of(std::uint8_t level) {
  const double s = static_cast<double>(level) / 255.0;
  const double linear = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  return static_cast<std::uint16_t>(std::lround(linear * 65535.0));
}

/// Of a share of full light; what is not from 0 to 1 (or not a number) becomes the nearest, or 0.
inline std::uint8_t level_of(double linear) {
  linear = linear > 0.0 ? std::min(linear, 1.0) : 0.0;
  const double s =
      linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(s * 255.0));
}

}  // namespace velum::formats
