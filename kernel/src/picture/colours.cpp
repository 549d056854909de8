// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "picture/colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace velum::picture {
namespace {

float to_srgb(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return static_cast<float>(x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055);
}

/// Oklab (Ottosson, 2020) to red, green and blue, linear in light: lightness, strength of the
/// colour, and its hue.
Eigen::Array3d from_polar(double lightness, double chroma, double hue) {
  const double a = chroma * std::cos(hue);
  const double b = chroma * std::sin(hue);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3.0);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3.0);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3.0);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

/// As strong as asked, or as a screen can show.
Colour colour(double lightness, double chroma, double hue) {
  Eigen::Array3d linear = from_polar(lightness, chroma, hue);
  while (chroma > 0.0 && ((linear < 0.0).any() || (linear > 1.0).any())) {
    chroma -= 0.001;
    linear = from_polar(lightness, chroma, hue);
  }
  return {to_srgb(linear[0]), to_srgb(linear[1]), to_srgb(linear[2])};
}

constexpr double kDegree = std::numbers::pi / 180.0;

std::array<Colour, 1024> make_ramp() {
  std::array<Colour, 1024> ramp;
  for (std::size_t i = 0; i < ramp.size(); ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(ramp.size() - 1);
    const double hue = (282.0 - 180.0 * t) * kDegree;
    ramp[i] = colour(0.36 + 0.56 * t, 0.14, hue);
  }
  return ramp;
}

}  // namespace

Colour colour_of(double share) {
  static const std::array<Colour, 1024> kRamp = make_ramp();
  const double at = std::min(std::max(0.0, share), 1.0) * static_cast<double>(kRamp.size() - 1);
  return kRamp[static_cast<std::size_t>(std::lround(at))];
}

Colour colour_of_label(std::int64_t label) {
  if (label < 0) return no_colour();
  // Hues by the golden angle never come close to one another soon.
  constexpr double kGolden = 137.50776405003785;
  const double hue = std::fmod(250.0 + kGolden * static_cast<double>(label % 4096), 360.0);
  constexpr std::array<double, 3> kLightness = {0.62, 0.74, 0.52};
  return colour(kLightness[static_cast<std::size_t>(label % 3)], 0.13, hue * kDegree);
}

}  // namespace velum::picture
