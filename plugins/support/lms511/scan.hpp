// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lms511/reader.hpp"
#include "lms511/writer.hpp"

namespace velum::lms511 {

/// Angles in telegrams are in 1/10000 degree.
inline constexpr double kTelegramAngle = 1e-4 * 0.017453292519943295;

/// One channel of a scan: ranges (DIST1 to DIST5) or remission (RSSI1 to RSSI5).
struct Channel {
  std::string name;
  float scale = 1.0F;
  float offset = 0.0F;
  std::int32_t start = -50000;  ///< angle of the first value [1/10000 deg]
  std::uint16_t step = 1667;    ///< [1/10000 deg], rounded: true_step() says what it means
  std::vector<std::uint16_t> values{};

  bool operator==(const Channel&) const = default;
};

struct EncoderReading {
  std::uint32_t position = 0;
  std::uint16_t speed = 0;
  bool operator==(const EncoderReading&) const = default;
};

/// Mounting of the device; an LMS 511 never sends it.
struct Placement {
  std::array<float, 6> pose{};  ///< x, y, z, turns about them
  std::uint8_t rotation_type = 0;
  std::uint8_t named = 0;
  bool operator==(const Placement&) const = default;
};

/// The device's clock. Begins at 1970-01-01 with power-up unless it was set.
struct Moment {
  std::uint16_t year = 1970;
  std::uint8_t month = 1;
  std::uint8_t day = 1;
  std::uint8_t hour = 0;
  std::uint8_t minute = 0;
  std::uint8_t second = 0;
  std::uint32_t microsecond = 0;
  bool operator==(const Moment&) const = default;
};

/// A change of a digital input within the scan.
struct InputEvent {
  std::string kind = "FDIN";
  std::uint32_t encoder_position = 0;
  std::uint32_t time = 0;  ///< device clock [us]
  std::int32_t angle = 0;  ///< [1/10000 deg]
  bool operator==(const InputEvent&) const = default;
};

/// LMDscandata, field by field.
struct Scan {
  bool polled = false;  ///< the answer to a read (sRA), not an event (sSN)
  std::uint16_t version = 0;
  std::uint16_t device = 1;
  std::uint32_t serial = 0;
  /// 0 0 is good; 1 0 stands in the first scan after a start, made while the laser was off.
  std::array<std::uint8_t, 2> status{};
  std::uint16_t telegram_counter = 0;
  std::uint16_t scan_counter = 0;  ///< one a revolution
  std::uint32_t start_time = 0;    ///< device clock [us]; wraps after 71 min 35 s
  std::uint32_t send_time = 0;     ///< the same clock
  std::array<std::uint8_t, 2> inputs{};
  std::array<std::uint8_t, 2> outputs{};
  std::uint16_t reserved = 0;
  std::uint32_t scan_frequency = 0;         ///< [1/100 Hz]
  std::uint32_t measurement_frequency = 0;  ///< shots a second / 100
  std::vector<EncoderReading> encoders;     ///< at most 3
  std::vector<Channel> channels16;
  std::vector<Channel> channels8;
  std::optional<Placement> placement;
  std::optional<std::string> name;
  std::optional<std::string> comment;
  std::optional<Moment> time;
  std::vector<InputEvent> events;

  bool operator==(const Scan&) const = default;

  /// The channel of that name in either block, or null.
  [[nodiscard]] const Channel* channel(std::string_view channel_name) const;
  /// Made with the laser on and the device free of errors; contamination is only a warning.
  [[nodiscard]] bool usable() const { return status[0] == 0 && status[1] != 1 && status[1] != 5; }
};

/// Is this LMDscandata?
[[nodiscard]] bool is_scan(const Reader& reader);
/// Reads what follows the telegram's name. Lenient at the end: a telegram may stop after any of the
/// flags behind the channels, and bytes behind the last one are ignored. Throws Malformed.
[[nodiscard]] Scan decode_scan(Reader& reader);
[[nodiscard]] Scan decode_scan(const Telegram& telegram);
/// The same without channels and what follows them: for those who only pass scans on.
[[nodiscard]] Scan decode_head(Reader& reader);
/// The payload of the telegram; decode_scan gives the same scan again. Channels hold at most 65535
/// values, those of eight bits no value above 255.
[[nodiscard]] std::string encode_scan(const Scan& scan, Dialect dialect);

/// What the values of a range channel are (listing 8014631): those below 16 are no distances.
struct ReturnCounts {
  std::uint64_t ranges = 0;
  std::uint64_t none = 0;         ///< 0: too dark, too near, too far, or filtered
  std::uint64_t dazzled = 0;      ///< 1
  std::uint64_t implausible = 0;  ///< 2 and 3
  std::uint64_t reserved = 0;     ///< 4 to 15
  void add(const Channel& channel);
  bool operator==(const ReturnCounts&) const = default;
};
/// The least value that is a distance.
inline constexpr std::uint16_t kLeastRange = 16;

/// The true angle between beams [rad] of a printed step [1/10000 deg]: the printed 1667, 3333 and
/// 6667 mean 1/6, 1/3 and 2/3 of a degree.
[[nodiscard]] double true_step(std::uint16_t step);
/// The true angle [rad] of a printed start [1/10000 deg]: the beams stand on multiples of 1/24
/// degree, so -48333 means -4 5/6.
[[nodiscard]] double true_start(std::int32_t start);

}  // namespace velum::lms511
