// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lms511/device.hpp"
#include "lms511/session.hpp"

namespace velum::lms511 {

/// How long to wait for what [s].
struct Timeouts {
  double connect = 2.0;
  double answer = 2.0;
  /// For a scanner to measure after its start, and for data after a change of its speed: the motor
  /// takes up to 30 s.
  double ready = 35.0;
  /// Without a telegram for longer, and for three revolutions, the connection counts as lost.
  double silence = 1.0;
  /// Without a line for longer, all attempts included, the scan is given up.
  double give_up = 30.0;
};

/// What to ask a device for. What is not set stays as the device has it.
struct DeviceSettings {
  std::string address = "192.168.0.1";
  std::optional<Dialect>
      dialect;  ///< unset: CoLa A on port 2111, else CoLa B; the other on silence
  bool login = true;
  std::optional<double> frequency;          ///< [Hz]
  std::optional<double> resolution;         ///< [rad]
  std::optional<double> view_from;          ///< [rad]
  std::optional<double> view_to;            ///< [rad]
  std::optional<std::uint8_t> echo_filter;  ///< 0 first, 1 all, 2 last
  bool remission = true;
  bool encoder = false;
  bool any_model = false;  ///< do not refuse what says it is no LMS 5xx
  Timeouts timeouts;

  /// Throws Error (Fault::graph) at the parameter that the device would not take.
  void check() const;
};

/// What the start of a device brought.
struct Started {
  std::vector<std::string> identity;       ///< "firmware = V1.80"
  std::vector<std::string> configuration;  ///< "scan_frequency = 2500"
  std::vector<std::string> warnings;       ///< what the device did not do
};

/// Logs in, asks the device who it is, sets it, starts it, waits until it measures and subscribes
/// to its scans. A refused login or setting is a warning: the scan goes on with what the device has
/// stored. Throws Error (Fault::device) for a device that is not supported or in error, and what
/// Session::ask throws.
[[nodiscard]] Started start_device(Session& session, Dialect dialect,
                                   const DeviceSettings& settings, const Interrupt& interrupt);
/// Ends the subscription, as far as the connection still allows.
void stop_device(Session& session, Dialect dialect, double seconds) noexcept;

}  // namespace velum::lms511
