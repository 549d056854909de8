// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/tilt.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "velum/error.hpp"

namespace velum::lms511 {
namespace {

void require(bool good, const char* parameter, const char* message) {
  if (!good) throw Error(Fault::graph, message).at(parameter);
}

// Seconds of a move over `way` [rad] that gains and loses speed evenly; a short one never reaches
// the speed.
double trapezoid_duration(double way, double speed, double acceleration) {
  const double ramp = speed * speed / acceleration;
  return way < ramp ? 2.0 * std::sqrt(way / acceleration) : way / speed + speed / acceleration;
}

}  // namespace

void TiltSettings::check() const {
  const bool turns = source == TiltSource::constant || source == TiltSource::trapezoid;
  if (source == TiltSource::constant)
    require(speed || end, "tilt_speed", "a constant speed needs tilt_speed, tilt_end or both");
  if (source == TiltSource::trapezoid) {
    require(end.has_value(), "tilt_end", "the trapezoidal law needs the angle at which it ends");
    require(speed.has_value(), "tilt_speed", "the trapezoidal law needs a speed");
    require(acceleration.has_value(), "tilt_acceleration", "the trapezoidal law needs one");
    require(*acceleration > 0.0, "tilt_acceleration", "an acceleration is above 0");
  }
  if (turns && speed) require(*speed != 0.0, "tilt_speed", "a speed of 0: use tilt = \"fixed\"");
  if (turns && speed && end) require(*end != start, "tilt_end", "the sweep ends where it begins");
  if (source == TiltSource::encoder)
    require(counts != 0.0, "encoder_counts", "the encoder's counts a turn are needed");
  if (source == TiltSource::file)
    require(!file.empty(), "tilt_file", "a file of times and angles is needed");
}

std::optional<double> TiltSettings::duration() const {
  if (!end || !speed) return std::nullopt;
  const double way = std::abs(*end - start);
  if (source == TiltSource::constant) return way / std::abs(*speed);
  if (source == TiltSource::trapezoid)
    return trapezoid_duration(way, std::abs(*speed), *acceleration);
  return std::nullopt;
}

TiltCurve::TiltCurve(const TiltSettings& settings, double span)
    : source_(settings.source),
      start_(settings.start),
      end_(settings.end.value_or(settings.start)),
      ends_(settings.end.has_value()),
      acceleration_(settings.acceleration.value_or(0.0)) {
  if (source_ == TiltSource::fixed) return;
  if (settings.speed)
    speed_ = ends_ ? std::copysign(*settings.speed, end_ - start_) : *settings.speed;
  else
    speed_ = span > 0.0 ? (end_ - start_) / span : 0.0;
}

TiltCurve::TiltCurve(std::vector<Knot> knots, double beyond)
    : source_(TiltSource::file), knots_(std::move(knots)), beyond_(beyond) {
  std::stable_sort(knots_.begin(), knots_.end(),
                   [](const Knot& a, const Knot& b) { return a.time < b.time; });
}

double TiltCurve::trapezoid(double time) const {
  const double way = std::abs(end_ - start_);
  const double total = trapezoid_duration(way, std::abs(speed_), acceleration_);
  const double t = std::clamp(time, 0.0, total);
  const double ramp = std::min(std::abs(speed_) / acceleration_, 0.5 * total);
  double gone = 0.0;
  if (t < ramp)
    gone = 0.5 * acceleration_ * t * t;
  else if (t > total - ramp)
    gone = way - 0.5 * acceleration_ * (total - t) * (total - t);
  else
    gone = 0.5 * acceleration_ * ramp * ramp + acceleration_ * ramp * (t - ramp);
  return start_ + std::copysign(gone, end_ - start_);
}

std::optional<double> TiltCurve::at(double time) const {
  if (source_ == TiltSource::fixed) return start_;
  if (source_ == TiltSource::trapezoid) return trapezoid(time);
  if (source_ == TiltSource::constant) {
    const double angle = start_ + speed_ * std::max(time, 0.0);
    if (!ends_) return angle;
    return speed_ < 0.0 ? std::max(angle, end_) : std::min(angle, end_);
  }
  if (knots_.empty() || time < knots_.front().time - beyond_ || time > knots_.back().time + beyond_)
    return std::nullopt;
  if (knots_.size() == 1) return knots_.front().angle;
  auto next = std::upper_bound(knots_.begin(), knots_.end(), time,
                               [](double t, const Knot& knot) { return t < knot.time; });
  next = std::clamp(next, knots_.begin() + 1, knots_.end() - 1);
  const Knot& a = *(next - 1);
  const Knot& b = *next;
  if (b.time <= a.time) return b.angle;
  return a.angle + (b.angle - a.angle) * (time - a.time) / (b.time - a.time);
}

double TiltCurve::middle() const {
  if (!knots_.empty()) return knots_[knots_.size() / 2].angle;
  return ends_ ? 0.5 * (start_ + end_) : start_;
}

}  // namespace velum::lms511
