// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/device.hpp"
#include "emulator/plate.hpp"
#include "emulator/view.hpp"

namespace velum::emulator {

/// The turning mirror: one revolution after another, each with its counters and times, as scans.
class Revolutions {
 public:
  /// What is left is the caller's: the device's settings may change between revolutions.
  Revolutions(const Device& device, const View& view, const Plate& plate)
      : device_(device), view_(view), plate_(plate) {}

  /// When the current revolution has been measured and can be sent, of the device's clock [us].
  [[nodiscard]] double due() const;
  /// Lets revolutions pass that nobody sees, up to `clock` [us].
  void pass_until(double clock);
  /// The current revolution; the next one begins. Nothing where the device's output interval leaves
  /// it out.
  [[nodiscard]] std::optional<lms511::Scan> next();
  /// The revolution before the current one, as the answer to a poll.
  [[nodiscard]] lms511::Scan last();
  /// Runs the plate from its first angle, beginning with the current revolution.
  void start_plate() { plate_.start(start_); }
  /// Is the plate at rest, at its beginning or at its end?
  [[nodiscard]] bool plate_rests() const { return !plate_.started() || plate_.finished(start_); }
  [[nodiscard]] bool plate_arrived() const { return plate_.finished(start_); }
  void mark_switched_on() { switched_on_ = true; }

 private:
  [[nodiscard]] lms511::Scan measure(std::uint64_t number, double start);

  const Device& device_;
  const View& view_;
  Plate plate_;
  std::uint64_t number_ = 1;     ///< of the current revolution
  double start_ = 0.0;           ///< of the current revolution [us]
  std::uint16_t telegrams_ = 0;  ///< sent so far
  bool switched_on_ = false;
};

}  // namespace velum::emulator
