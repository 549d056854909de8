// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/live.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "velum/error.hpp"

namespace velum::lms511 {
namespace {

std::optional<double> plain(const std::optional<Angle>& angle) {
  return angle ? std::optional<double>(angle->radians) : std::nullopt;
}

}  // namespace

void ScannerParameters::check_scanner() const {
  const Acquisition::Settings settings = acquisition();
  settings.device.check();
  settings.trigger.check();
  if (!feed.empty()) Listener::check(feed);
}

Acquisition::Settings ScannerParameters::acquisition() const {
  Acquisition::Settings settings;
  DeviceSettings& device = settings.device;
  device.address = address;
  if (encoding != Encoding::automatic)
    device.dialect = encoding == Encoding::cola_a ? Dialect::ascii : Dialect::binary;
  device.login = login;
  device.frequency = frequency;
  device.resolution = plain(resolution);
  device.view_from = plain(view_from);
  device.view_to = plain(view_to);
  if (echo_filter != EchoFilter::stored)
    device.echo_filter = static_cast<std::uint8_t>(static_cast<int>(echo_filter) - 1);
  device.remission = remission;
  device.encoder = encoder_block;
  device.any_model = any_model;
  device.timeouts = {.connect = connect_timeout,
                     .answer = answer_timeout,
                     .ready = ready_timeout,
                     .silence = silence_timeout,
                     .give_up = give_up};
  settings.trigger = {.source = trigger, .count = trigger_count, .timeout = trigger_timeout};
  settings.feed = feed;
  return settings;
}

SweepEnd::SweepEnd(const ScannerParameters& scanner, const TiltSettings& tilt)
    : lines_(scanner.lines), tilt_(tilt) {
  if (scanner.duration) duration_ = scanner.duration->seconds;
  if (const auto law = tilt.duration(); law && !duration_) duration_ = law;
  const bool by_angle =
      (tilt.source == TiltSource::encoder || tilt.source == TiltSource::feed) && tilt.end;
  if (!lines_ && !duration_ && !by_angle)
    throw Error(Error(Fault::graph, "nothing ends the sweep").at("lines"))
        .hint("set lines, duration, or tilt_end with a tilt_speed, an encoder or a feed");
}

// Measured angles end the sweep where they have passed its end, seen from where they began.
void SweepEnd::see_angle(double angle) {
  if (!tilt_.end) return;
  if (!first_angle_) first_angle_ = angle;
  const double way = *tilt_.end - *first_angle_;
  constexpr double kRounding = 1e-4;  // a plate that stops at the end may read a count less
  if (way != 0.0) now_at((angle - *first_angle_) / way + kRounding);
}

void SweepEnd::see(const LineGatherer& lines) {
  if (tilt_.source == TiltSource::feed && !lines.tilt().empty())
    see_angle(lines.tilt().back().angle);
  if (lines.lines().empty()) return;
  const Line& last = lines.lines().back();
  if (!first_) first_ = lines.trigger().value_or(last.arrival);
  if (lines_) now_at(static_cast<double>(lines.counts().lines) / *lines_);
  if (duration_) now_at(1e-9 * static_cast<double>(last.arrival - *first_) / *duration_);
  if (tilt_.source == TiltSource::encoder && last.encoder)
    see_angle((static_cast<double>(static_cast<std::int32_t>(*last.encoder)) - tilt_.zero) /
              tilt_.counts * 2.0 * std::numbers::pi);
}

}  // namespace velum::lms511
