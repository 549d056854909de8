// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "emulator/mirror.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace velum::emulator {
namespace {

constexpr double kTelegramAngle = 1e-4 * std::numbers::pi / 180.0;
constexpr double kTurn = 3'600'000.0;  // [1/10000 deg]

// Printed angles are cut, not rounded: 2/3 degree is 6667, but the beam at 5 1/3 prints 53333.
std::int32_t cut(double angle) {
  return static_cast<std::int32_t>(std::trunc(angle + (angle < 0.0 ? -1e-6 : 1e-6)));
}

// In which order the revolutions of a whole scan shift the grid, in parts of the step.
std::uint32_t shift_of(std::uint64_t number, std::uint32_t revolutions) {
  constexpr std::array<std::uint32_t, 4> kFour{0, 2, 1, 3};
  const auto at = static_cast<std::uint32_t>(number % revolutions);
  return revolutions == 4 ? kFour[at] : at;
}

}  // namespace

// The device prints 1667, 3333, 6667 for 1/6, 1/3, 2/3 degree.
double Mirror::true_step() const {
  const double printed = mode_.resolution;
  const double whole = std::round(20000.0 / printed);
  const double fine = printed < 10000.0 ? 20000.0 / whole : printed;
  return fine * mode_.revolutions;
}

std::uint32_t Mirror::printed_step() const {
  return static_cast<std::uint32_t>(std::lround(true_step()));
}

std::uint32_t Mirror::shots() const {
  return static_cast<std::uint32_t>(std::lround(kTurn / true_step() * mode_.frequency / 1e4));
}

double Mirror::delay(double angle) const {
  const double turned = angle - lms511::kViewFrom * kTelegramAngle;
  return period() * turned / (2.0 * std::numbers::pi);
}

Turn Mirror::turn(std::uint64_t number, std::int32_t from, std::int32_t to) const {
  const std::uint32_t shift = shift_of(number, mode_.revolutions);
  const double step = true_step();
  const double grid = lms511::kViewFrom + shift * step / mode_.revolutions;
  const auto skipped = std::max(0.0, std::ceil((from - grid) / step - 1e-6));
  const double first = grid + skipped * step;
  Turn turn;
  turn.step = static_cast<std::uint16_t>(printed_step());
  turn.beams = first > to ? std::uint16_t{0}
                          : static_cast<std::uint16_t>(std::floor((to - first) / step + 1e-6) + 1);
  // The shift is added as it is printed: real devices say -44999 for -4.5 degrees.
  const auto printed_shift = static_cast<std::int32_t>(shift * mode_.resolution);
  turn.start = lms511::kViewFrom + printed_shift + cut(skipped * step);
  turn.first = first * kTelegramAngle;
  turn.spacing = step * kTelegramAngle;
  return turn;
}

}  // namespace velum::emulator
