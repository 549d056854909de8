// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace velum::lms511 {

/// Ports of a device as delivered: CoLa A always, and the host port, whose dialect can be switched.
inline constexpr std::uint16_t kAsciiPort = 2111;
inline constexpr std::uint16_t kHostPort = 2112;

/// User levels of SetAccessMode with the hash of their delivered password.
struct Access {
  std::uint8_t level;
  std::uint32_t hash;
};
inline constexpr Access kMaintenance{2, 0xB21ACE26};
inline constexpr Access kAuthorisedClient{3, 0xF4724744};
inline constexpr Access kService{4, 0x81BE23AA};

/// A pair of scan frequency and resolution that an LMS 511 PRO can be set to. Interlaced ones turn
/// with a coarser step and shift it from revolution to revolution.
struct Mode {
  std::uint32_t frequency;    ///< [1/100 Hz]
  std::uint32_t resolution;   ///< as printed [1/10000 deg]
  std::uint32_t revolutions;  ///< that make up one whole scan; 1: not interlaced
};
/// All of them (listing 8014631 and operating manual; 100 Hz at 1/6 degree takes four revolutions,
/// as real devices do it).
inline constexpr std::array<Mode, 17> kModes = {{{2500, 1667, 1},
                                                 {2500, 2500, 1},
                                                 {3500, 2500, 1},
                                                 {3500, 5000, 1},
                                                 {5000, 3333, 1},
                                                 {5000, 5000, 1},
                                                 {7500, 5000, 1},
                                                 {7500, 10000, 1},
                                                 {10000, 6667, 1},
                                                 {10000, 10000, 1},
                                                 {5000, 1667, 2},
                                                 {7500, 2500, 2},
                                                 {10000, 1667, 4},
                                                 {10000, 3333, 2},
                                                 {10000, 5000, 2},
                                                 {2500, 833, 2},
                                                 {2500, 417, 4}}};

/// The mode of a pair, whose resolution may be off by the rounding of its print; nothing when the
/// device does not allow it.
[[nodiscard]] std::optional<Mode> mode_of(std::uint32_t frequency, std::uint32_t resolution);

/// The field of view [1/10000 deg]; 90 degrees is straight ahead.
inline constexpr std::int32_t kViewFrom = -50000;
inline constexpr std::int32_t kViewTo = 1850000;

/// Answers of STlms: what the device is doing.
enum class DeviceState : std::uint16_t { ready = 6, measuring = 7, updating = 8, error = 10 };

}  // namespace velum::lms511
