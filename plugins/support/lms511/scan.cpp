// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/scan.hpp"

#include <cmath>
#include <numbers>

namespace velum::lms511 {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

const Channel* find(const std::vector<Channel>& channels, std::string_view name) {
  for (const Channel& channel : channels)
    if (channel.name == name) return &channel;
  return nullptr;
}

}  // namespace

const Channel* Scan::channel(std::string_view channel_name) const {
  const Channel* wide = find(channels16, channel_name);
  return wide != nullptr ? wide : find(channels8, channel_name);
}

void ReturnCounts::add(const Channel& channel) {
  for (const std::uint16_t value : channel.values) {
    if (value >= kLeastRange)
      ++ranges;
    else if (value == 0)
      ++none;
    else if (value == 1)
      ++dazzled;
    else if (value <= 3)
      ++implausible;
    else
      ++reserved;
  }
}

double true_step(std::uint16_t step) {
  const double printed = 1e-4 * step;
  if (step == 0 || printed >= 1.0) return printed * kDegree;
  return 2.0 / std::round(2.0 / printed) * kDegree;
}

double true_start(std::int32_t start) {
  constexpr double kGrid = 24.0;       // beams a degree at the finest interlaced resolution
  constexpr double kPrinted = 1.5e-4;  // [deg], what cutting or rounding to 4 decimals may do
  const double printed = 1e-4 * start;
  const double exact = std::round(printed * kGrid) / kGrid;
  return (std::abs(exact - printed) < kPrinted ? exact : printed) * kDegree;
}

}  // namespace velum::lms511
