// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "emulator/revolutions.hpp"

#include <cmath>

namespace velum::emulator {
namespace {

// From the end of a revolution to its telegram [us]: real devices take 0.3 to 3.5 ms.
constexpr double kLatency = 900.0;
constexpr std::size_t kEchoes = 5;
constexpr std::uint32_t kAllEchoes = 1;

// Where LMDscandatacfg has its switches.
enum Switch : std::size_t { kRemission = 2, kEncoder = 5, kName = 8, kTime = 10, kInterval = 11 };

// Clocks of 32 bits wrap.
std::uint32_t wrapped(double microseconds) {
  return static_cast<std::uint32_t>(static_cast<std::uint64_t>(microseconds));
}

// The first channel has the values; with all echoes four more, of which none ever comes back.
std::vector<lms511::Channel> channels(const std::string& name, const Turn& turn,
                                      std::vector<std::uint16_t> values, bool all_echoes) {
  std::vector<lms511::Channel> made;
  made.push_back(
      {.name = name + "1", .start = turn.start, .step = turn.step, .values = std::move(values)});
  for (std::size_t echo = 2; all_echoes && echo <= kEchoes; ++echo) {
    made.push_back(made.front());
    made.back().name.back() = static_cast<char>('0' + echo);
    made.back().values.assign(turn.beams, 0);
  }
  return made;
}

std::uint8_t outputs_on(const Profile& profile) {
  unsigned bits = 0;
  for (unsigned i = 0; i < 6; ++i)
    if (profile.outputs[i].state == 1) bits |= 1U << i;
  return static_cast<std::uint8_t>(bits);
}

}  // namespace

double Revolutions::due() const {
  return start_ + Mirror(device_.mode).period() + kLatency;
}

void Revolutions::pass_until(double clock) {
  const double period = Mirror(device_.mode).period();
  const double passed = std::floor((clock - start_ - kLatency) / period);
  if (passed <= 0.0) return;
  number_ += static_cast<std::uint64_t>(passed);
  start_ += passed * period;
}

lms511::Scan Revolutions::measure(std::uint64_t number, double start) {
  const Mirror mirror(device_.mode);
  const Turn turn = mirror.turn(number - 1, device_.range_from, device_.range_to);
  Ranges ranges = view_.look(mirror, turn, plate_, number, start);
  const Variables& variables = device_.variables;
  const auto on = [&](std::size_t at) { return variables.value("LMDscandatacfg", at) != 0; };
  const bool all = variables.value("FREchoFilter") == kAllEchoes;
  lms511::Scan scan;
  scan.serial = device_.profile.serial;
  scan.status[0] = switched_on_ ? 1 : 0;
  scan.telegram_counter = telegrams_++;
  scan.scan_counter = static_cast<std::uint16_t>(number);
  scan.start_time = wrapped(start);
  scan.send_time = wrapped(start + mirror.period() + kLatency);
  scan.outputs[0] = outputs_on(device_.profile);
  scan.scan_frequency = device_.mode.frequency;
  scan.measurement_frequency = mirror.shots();
  if (on(kEncoder)) scan.encoders.push_back({plate_.counts(start), 0});
  scan.channels16 = channels("DIST", turn, std::move(ranges.distances), all);
  if (on(kRemission)) scan.channels8 = channels("RSSI", turn, std::move(ranges.remissions), all);
  if (on(kName)) scan.name = device_.profile.location.substr(0, 16);
  if (on(kTime)) scan.time = device_.moment();
  switched_on_ = false;
  return scan;
}

std::optional<lms511::Scan> Revolutions::next() {
  const std::uint32_t interval = device_.variables.value("LMDscandatacfg", kInterval);
  const bool wanted = interval < 2 || number_ % interval == 0;
  std::optional<lms511::Scan> scan;
  if (wanted) scan = measure(number_, start_);
  ++number_;
  start_ += Mirror(device_.mode).period();
  return scan;
}

lms511::Scan Revolutions::last() {
  const double period = Mirror(device_.mode).period();
  if (start_ < period) static_cast<void>(next());
  lms511::Scan scan = measure(number_ - 1, start_ - period);
  scan.polled = true;
  return scan;
}

}  // namespace velum::emulator
