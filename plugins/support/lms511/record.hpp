// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "lms511/frame.hpp"

namespace velum::lms511 {

/// What happened at a scanner, in the order in which it was seen. A live scan and a recording are
/// both a stream of these, so that both give the same cloud.
enum class Event : std::uint8_t {
  ascii_telegram = 1,   ///< payload of a CoLa A telegram
  binary_telegram = 2,  ///< payload of a CoLa B telegram
  tilt = 3,             ///< f64 little-endian: angle of the tilt plate [rad]
  trigger = 4,          ///< text: where from
  connected = 5,        ///< text: address; a new connection, whose clock and counters are its own
  gap = 6,              ///< text: why nothing came between the telegram before and the one behind
  identity = 7,         ///< text: a line a fact, such as "firmware = V1.80"
  configuration = 8,    ///< text: a line a setting that the device confirmed
  start = 9,            ///< text: wall clock at time 0, ISO 8601 in UTC
  end = 10,             ///< text: why the recording ended; missing after a kill
  part = 11,            ///< in a later part of a rotated recording: what stands before is repeated
};

/// Not known when it happened, as in a dump of bytes.
inline constexpr std::int64_t kNoTime = INT64_MIN;

/// One event. `time` is that of its arrival [ns] since the start of the acquisition.
struct Record {
  Event event = Event::start;
  std::int64_t time = kNoTime;
  std::string_view bytes{};  ///< valid until the source gives the next record
};

/// Where records go.
using RecordSink = std::function<void(const Record&)>;

/// Is it a telegram, and which one.
[[nodiscard]] inline bool is_telegram(const Record& record) {
  return record.event == Event::ascii_telegram || record.event == Event::binary_telegram;
}
[[nodiscard]] inline Telegram telegram_of(const Record& record) {
  return {record.event == Event::ascii_telegram ? Dialect::ascii : Dialect::binary, record.bytes};
}
[[nodiscard]] inline Record record_of(const Telegram& telegram, std::int64_t time) {
  return {telegram.dialect == Dialect::ascii ? Event::ascii_telegram : Event::binary_telegram, time,
          telegram.payload};
}

}  // namespace velum::lms511
