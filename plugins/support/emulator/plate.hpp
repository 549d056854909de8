// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace velum::emulator {

/// The plate that tilts the scanner: rests at the first angle, runs to the last one at constant
/// speed once started, and stays there. Its encoder tells where it is.
class Plate {
 public:
  struct Law {
    double from = 0.0;   ///< [rad]
    double to = 0.0;     ///< [rad]
    double speed = 0.0;  ///< [rad/s], above 0 unless from is to
  };
  struct Encoder {
    double counts_per_turn = 3'600'000.0;
    double zero = 2'000'000.0;  ///< counts at tilt 0, so that no tilt is negative
  };
  Plate(const Law& law, const Encoder& encoder) : law_(law), encoder_(encoder) {}

  /// Begins to run at a time of the device's clock [us], from the first angle.
  void start(double microseconds) { started_ = microseconds; }
  [[nodiscard]] bool started() const { return started_ >= 0.0; }
  /// Has it arrived?
  [[nodiscard]] bool finished(double microseconds) const;
  /// [rad]
  [[nodiscard]] double tilt(double microseconds) const;
  [[nodiscard]] std::uint32_t counts(double microseconds) const;

 private:
  Law law_;
  Encoder encoder_;
  double started_ = -1.0;
};

}  // namespace velum::emulator
