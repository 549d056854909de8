// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "emulator/plate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace velum::emulator {

bool Plate::finished(double microseconds) const {
  if (!started()) return false;
  return (microseconds - started_) * 1e-6 * law_.speed >= std::abs(law_.to - law_.from);
}

double Plate::tilt(double microseconds) const {
  if (!started()) return law_.from;
  const double run = std::max(0.0, (microseconds - started_) * 1e-6 * law_.speed);
  const double whole = law_.to - law_.from;
  return law_.from + std::copysign(std::min(run, std::abs(whole)), whole);
}

std::uint32_t Plate::counts(double microseconds) const {
  const double turns = tilt(microseconds) / (2.0 * std::numbers::pi);
  const double counts = std::round(encoder_.zero + encoder_.counts_per_turn * turns);
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(counts));
}

}  // namespace velum::emulator
