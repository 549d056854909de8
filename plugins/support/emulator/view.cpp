// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "emulator/view.hpp"

#include <algorithm>
#include <cmath>

namespace velum::emulator {
namespace {

constexpr double kMillimetre = 1e3;
// Values below 16 are no distances, and those above 65 m do not fit at a scale of 1.
constexpr double kLeast = 16.0;
constexpr double kMost = 65000.0;
// White at 4.5 m gives the strongest remission that telegrams know.
constexpr double kFullSignal = 0.05;
constexpr std::uint64_t kMostBeams = 8192;

std::uint16_t distance(double metres) {
  const double millimetres = std::round(kMillimetre * metres);
  if (millimetres < kLeast || millimetres > kMost) return 0;
  return static_cast<std::uint16_t>(millimetres);
}

std::uint16_t remission(double signal) {
  const double share = std::sqrt(std::clamp(signal / kFullSignal, 0.0, 1.0));
  return static_cast<std::uint16_t>(std::clamp(std::round(254.0 * share), 1.0, 254.0));
}

}  // namespace

View::View(scene::Scene scene, const std::string& scanner, const Random& random)
    : scene_(std::move(scene)),
      scanner_(scene_.scanner(scanner)),
      finder_(scene_, scanner_),
      random_(random) {}

Ranges View::look(const Mirror& mirror, const Turn& turn, const Plate& plate, std::uint64_t number,
                  double start) const {
  Ranges ranges;
  ranges.distances.reserve(turn.beams);
  ranges.remissions.reserve(turn.beams);
  for (std::uint16_t i = 0; i < turn.beams; ++i) {
    const double angle = turn.first + i * turn.spacing;
    const double time = start + mirror.delay(angle);
    const auto echo = finder_.measure({angle, plate.tilt(time), 1e-6 * time},
                                      random_.split(number * kMostBeams + i));
    ranges.distances.push_back(echo ? distance(echo->range) : std::uint16_t{0});
    const bool seen = ranges.distances.back() != 0;
    ranges.remissions.push_back(seen ? remission(echo->signal) : std::uint16_t{0});
  }
  return ranges;
}

}  // namespace velum::emulator
