// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lms511/record.hpp"
#include "lms511/scan.hpp"

namespace velum::lms511 {

/// One revolution of the mirror, as the device sent it.
struct Line {
  std::vector<Channel> ranges;     ///< one an echo, nearest first
  std::vector<Channel> remission;  ///< as many or none
  std::int32_t number = 0;         ///< revolutions since the first line; jumps where some are lost
  std::uint32_t clock = 0;         ///< another one after a new connection or a restart
  std::int64_t arrival = kNoTime;  ///< [ns]
  std::int64_t start = 0;          ///< device clock, unwrapped [us]
  std::int64_t sent = 0;           ///< the same clock
  double frequency = 25.0;         ///< [Hz]
  std::optional<std::uint32_t> encoder;
};

/// A measured angle of the tilt plate.
struct TiltSample {
  std::int64_t time = 0;  ///< arrival [ns]
  double angle = 0.0;     ///< [rad]
};

/// What came in, for the record and for messages.
struct LineCounts {
  std::uint64_t telegrams = 0;  ///< scans, good or not
  std::uint64_t lines = 0;
  std::uint64_t lost = 0;       ///< revolutions that the counter skipped
  std::uint64_t unusable = 0;   ///< made with the laser off, or with a device error
  std::uint64_t repeated = 0;   ///< the same revolution again, when polled
  std::uint64_t malformed = 0;  ///< scans that contradict themselves or those before
  std::uint64_t connections = 0;
  std::uint64_t gaps = 0;
  ReturnCounts returns;  ///< of the first echo
};

/// Gathers the lines of one scanner from its records. Live scan and replay give it the same records
/// and so get the same lines.
class LineGatherer {
 public:
  /// True when the record was a line that is to be used.
  bool add(const Record& record);

  [[nodiscard]] const std::vector<Line>& lines() const { return lines_; }
  [[nodiscard]] const std::vector<TiltSample>& tilt() const { return tilt_; }
  /// When the trigger came [ns], or nothing.
  [[nodiscard]] std::optional<std::int64_t> trigger() const { return trigger_; }
  [[nodiscard]] const LineCounts& counts() const { return counts_; }
  /// Why and when each gap began, and when the connection was back.
  [[nodiscard]] const std::vector<std::string>& gaps() const { return gaps_; }
  /// Number of the device; 0 before the first scan.
  [[nodiscard]] std::uint32_t serial() const { return serial_; }
  /// Forgets the lines, not the counts: for those who only watch.
  void drop_lines();

 private:
  bool add_scan(Scan scan, std::int64_t arrival);
  [[nodiscard]] bool fits(const Scan& scan) const;
  [[nodiscard]] bool follows(const Scan& scan) const;
  std::int64_t unwrap(std::uint32_t clock);

  std::vector<Line> lines_;
  std::vector<TiltSample> tilt_;
  std::optional<std::int64_t> trigger_;
  std::vector<std::string> gaps_;
  LineCounts counts_;
  std::uint32_t serial_ = 0;
  std::int32_t number_ = 0;
  bool gap_open_ = false;
  bool doubted_ = false;  ///< the scan before did not follow the last good one
  bool fresh_ = true;     ///< no scan yet on this connection
  std::uint16_t counter_ = 0;
  std::int64_t clock_ = 0;
  std::uint32_t clocks_ = 0;
};

}  // namespace velum::lms511
