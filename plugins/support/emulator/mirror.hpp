// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "lms511/device.hpp"

namespace velum::emulator {

/// The beams of one revolution of the mirror: those of the grid from -5 degrees that lie in the
/// output range. Interlaced modes shift the grid from revolution to revolution.
struct Turn {
  std::int32_t start = 0;  ///< angle of the first beam as the device prints it [1/10000 deg]
  std::uint16_t step = 0;  ///< as the device prints it [1/10000 deg]
  std::uint16_t beams = 0;
  double first = 0.0;    ///< true angle of the first beam [rad]
  double spacing = 0.0;  ///< true angle between beams [rad]
};

/// How fast and how finely the mirror looks.
class Mirror {
 public:
  explicit Mirror(const lms511::Mode& mode) : mode_(mode) {}
  [[nodiscard]] const lms511::Mode& mode() const { return mode_; }
  /// Of a revolution [us].
  [[nodiscard]] double period() const { return 1e8 / mode_.frequency; }
  /// Shots a second / 100, as telegrams state it.
  [[nodiscard]] std::uint32_t shots() const;
  /// The beams of revolution `number` from `from` to `to` [1/10000 deg].
  [[nodiscard]] Turn turn(std::uint64_t number, std::int32_t from, std::int32_t to) const;
  /// From the first beam at -5 degrees to one at `angle` [rad], within a revolution [us].
  [[nodiscard]] double delay(double angle) const;

 private:
  /// The step of one revolution as printed and in truth [1/10000 deg].
  [[nodiscard]] std::uint32_t printed_step() const;
  [[nodiscard]] double true_step() const;
  lms511::Mode mode_;
};

}  // namespace velum::emulator
