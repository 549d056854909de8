// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/lines.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <utility>

namespace velum::lms511 {
namespace {

std::vector<Channel> take(Scan& scan, std::string_view prefix) {
  std::vector<Channel> taken;
  for (auto* block : {&scan.channels16, &scan.channels8})
    for (Channel& channel : *block)
      if (channel.name.starts_with(prefix)) taken.push_back(std::move(channel));
  return taken;
}

}  // namespace

bool LineGatherer::add(const Record& record) {
  switch (record.event) {
    case Event::ascii_telegram:
    case Event::binary_telegram:
      try {
        Reader reader(telegram_of(record));
        if (!is_scan(reader)) return false;
        ++counts_.telegrams;
        return add_scan(decode_scan(reader), record.time);
      } catch (const Malformed&) {
        ++counts_.malformed;
        return false;
      }
    case Event::connected:
      fresh_ = true;
      ++clocks_;
      ++counts_.connections;
      if (gap_open_)
        gaps_.back() +=
            fmt::format(", connected again at {:.3f} s", 1e-9 * static_cast<double>(record.time));
      gap_open_ = false;
      return false;
    case Event::gap:
      ++counts_.gaps;
      gap_open_ = true;
      gaps_.push_back(
          fmt::format("{} at {:.3f} s", record.bytes, 1e-9 * static_cast<double>(record.time)));
      return false;
    case Event::tilt:
      if (double angle = 0.0; record.bytes.size() == sizeof(angle)) {
        std::memcpy(&angle, record.bytes.data(), sizeof(angle));
        tilt_.push_back({record.time, angle});
      }
      return false;
    case Event::trigger:
      trigger_ = record.time;
      return false;
    default:
      return false;
  }
}

// Every scan of a connection is of one device; a changed digit in CoLa A shows up here.
bool LineGatherer::fits(const Scan& scan) const {
  constexpr std::uint32_t kLeastFrequency = 100;
  constexpr std::uint32_t kMostFrequency = 100000;
  if (scan.channel("DIST1") == nullptr || scan.scan_frequency < kLeastFrequency ||
      scan.scan_frequency > kMostFrequency)
    return false;
  return serial_ == 0 || scan.serial == serial_;
}

// The counter and the clock of a scan tell the same story: CoLa A has no checksum, and a digit that
// changed in one of them shows up against the other.
bool LineGatherer::follows(const Scan& scan) const {
  constexpr double kOfRevolution = 0.25;
  constexpr double kOfTime = 0.02;  // the mirror's speed is good to one percent
  const auto step = static_cast<std::uint16_t>(scan.scan_counter - counter_);
  if (fresh_ || step == 0) return true;
  const double revolution = 1e8 / scan.scan_frequency;  // [us]
  const double expected = revolution * step;
  const double elapsed =
      static_cast<std::int32_t>(scan.start_time - static_cast<std::uint32_t>(clock_));
  return std::abs(elapsed - expected) < kOfRevolution * revolution + kOfTime * expected;
}

std::int64_t LineGatherer::unwrap(std::uint32_t clock) {
  if (fresh_) return clock;
  return clock_ + static_cast<std::int32_t>(clock - static_cast<std::uint32_t>(clock_));
}

bool LineGatherer::add_scan(Scan scan, std::int64_t arrival) {
  if (!fits(scan)) {
    ++counts_.malformed;
    return false;
  }
  // One scan out of step is damaged; two in a row are a device that began anew.
  if (!follows(scan)) {
    if (!doubted_) {
      doubted_ = true;
      ++counts_.malformed;
      return false;
    }
    fresh_ = true;
    ++clocks_;
  }
  doubted_ = false;
  const bool first = counts_.telegrams == counts_.malformed + 1;
  const auto step = static_cast<std::uint16_t>(scan.scan_counter - counter_);
  constexpr std::uint16_t kBackwards = 0x8000;
  if (!fresh_ && step == 0) {
    ++counts_.repeated;
    return false;
  }
  if (!fresh_ && step < kBackwards) {
    counts_.lost += step - 1U;
    number_ += step;
  } else if (!first) {
    ++number_;
  }
  clock_ = unwrap(scan.start_time);
  counter_ = scan.scan_counter;
  serial_ = scan.serial;
  fresh_ = false;
  if (!scan.usable()) {
    ++counts_.unusable;
    return false;
  }
  Line line;
  line.number = number_;
  line.clock = clocks_;
  line.arrival = arrival;
  line.start = clock_;
  line.sent = clock_ + static_cast<std::int32_t>(scan.send_time - scan.start_time);
  line.frequency = 0.01 * scan.scan_frequency;
  if (!scan.encoders.empty()) line.encoder = scan.encoders.front().position;
  line.ranges = take(scan, "DIST");
  line.remission = take(scan, "RSSI");
  counts_.returns.add(line.ranges.front());
  ++counts_.lines;
  lines_.push_back(std::move(line));
  return true;
}

void LineGatherer::drop_lines() {
  lines_.clear();
  tilt_.clear();
}

}  // namespace velum::lms511
