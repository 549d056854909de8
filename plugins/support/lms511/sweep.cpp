// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <span>

namespace velum::lms511 {
namespace {

constexpr double kNanosecond = 1e-9;
constexpr double kMicrosecond = 1e-6;

// When each device clock was 0, on the clock of arrivals [s]. The telegram that
// took the least time over the network says it best.
class Clock {
 public:
  explicit Clock(const std::vector<Line>& lines) {
    for (const Line& line : lines) {
      if (line.arrival == kNoTime) continue;
      const double zero = kNanosecond * static_cast<double>(line.arrival) -
                          kMicrosecond * static_cast<double>(line.sent);
      const auto [at, fresh] = zeros_.try_emplace(line.clock, zero);
      if (!fresh) at->second = std::min(at->second, zero);
    }
  }
  [[nodiscard]] double start(const Line& line) const {
    const auto zero = zeros_.find(line.clock);
    return kMicrosecond * static_cast<double>(line.start) +
           (zero == zeros_.end() ? 0.0 : zero->second);
  }

 private:
  std::map<std::uint32_t, double> zeros_;
};

// A line with its start [s] since the sweep's begin.
struct Timed {
  const Line* line;
  double start;
};

struct Point {
  Eigen::Vector3f at;
  float tilt;
  float range;
  float intensity;
  double time;
  std::int32_t beam;
  std::int32_t line;
  std::int32_t echo;
};

class Sweep {
 public:
  Sweep(const LineGatherer& gathered, const SweepSettings& settings)
      : settings_(settings), mount_(settings.mounting, settings.calibration) {
    const Clock clock(gathered.lines());
    for (const Line& line : gathered.lines())
      lines_.push_back({&line, clock.start(line) + settings.calibration.time_offset});
    begin(gathered);
    curve_.emplace(make_curve(gathered));
  }

  [[nodiscard]] Cloud cloud(SweepCounts& counts, Context& context) {
    std::vector<std::vector<Point>> points(lines_.size());
    std::vector<SweepCounts> parts(lines_.size());
    parallel_for(context, static_cast<Index>(lines_.size()), 16, [&](Index from, Index to) {
      context.check();
      for (auto i = static_cast<std::size_t>(from); i < static_cast<std::size_t>(to); ++i)
        points[i] = points_of(lines_[i], parts[i]);
    });
    for (const SweepCounts& part : parts) {
      counts.untilted += part.untilted;
      counts.out_of_range += part.out_of_range;
    }
    if (!lines_.empty()) counts.span = lines_.back().start - lines_.front().start;
    counts.skew = triggered_ && !lines_.empty() ? lines_.front().start : 0.0;
    return gathered_into_cloud(points);
  }

 private:
  // The sweep begins at the trigger; lines that began before it are not part of it.
  void begin(const LineGatherer& gathered) {
    if (lines_.empty()) return;
    double zero = lines_.front().start;
    if (gathered.trigger()) {
      zero = kNanosecond * static_cast<double>(*gathered.trigger());
      triggered_ = true;
    }
    zero_ = zero;
    std::erase_if(lines_, [&](const Timed& timed) { return timed.start < zero; });
    for (Timed& timed : lines_) timed.start -= zero;
  }

  [[nodiscard]] TiltCurve make_curve(const LineGatherer& gathered) const {
    const TiltSettings& tilt = settings_.tilt;
    if (tilt.source == TiltSource::encoder) return TiltCurve(encoder_knots(), 0.1);
    if (tilt.source == TiltSource::file) return TiltCurve(read_tilt_file(tilt.file), 0.0);
    if (tilt.source == TiltSource::feed) {
      std::vector<TiltCurve::Knot> knots;
      for (const TiltSample& sample : gathered.tilt())
        knots.push_back({kNanosecond * static_cast<double>(sample.time) - zero_, sample.angle});
      return TiltCurve(std::move(knots), 0.0);
    }
    return TiltCurve(tilt, lines_.empty() ? 0.0 : lines_.back().start - lines_.front().start);
  }

  [[nodiscard]] std::vector<TiltCurve::Knot> encoder_knots() const {
    std::vector<TiltCurve::Knot> knots;
    std::int64_t count = 0;
    for (const Timed& timed : lines_) {
      if (!timed.line->encoder) continue;
      const std::uint32_t reading = *timed.line->encoder;
      count = knots.empty()
                  ? static_cast<std::int32_t>(reading)
                  : count + static_cast<std::int32_t>(reading - static_cast<std::uint32_t>(count));
      knots.push_back({timed.start, (static_cast<double>(count) - settings_.tilt.zero) /
                                        settings_.tilt.counts * 2.0 * std::numbers::pi});
    }
    return knots;
  }

  // Is this echo of the beam a distance that is asked for?
  [[nodiscard]] bool wanted(const Line& line, std::size_t echo, std::size_t beam) const {
    const auto& ranges = line.ranges;
    if (ranges[echo].values[beam] < kLeastRange) return false;
    if (settings_.echoes == Echoes::all) return true;
    const bool first = settings_.echoes == Echoes::first;
    const std::size_t from = first ? 0 : echo + 1;
    const std::size_t to = first ? echo : ranges.size();
    for (std::size_t other = from; other < to; ++other)
      if (ranges[other].values[beam] >= kLeastRange) return false;
    return true;
  }

  [[nodiscard]] std::vector<Point> points_of(const Timed& timed, SweepCounts& counts) const {
    std::vector<Point> points;
    const Line& line = *timed.line;
    const Channel& first = line.ranges.front();
    const double start = true_start(first.start);
    const double step = true_step(first.step);
    points.reserve(first.values.size());
    for (std::size_t beam = 0; beam < first.values.size(); ++beam) {
      const double angle = start + step * static_cast<double>(beam);
      const double time = timed.start + beam_delay(angle, line.frequency);
      std::optional<double> tilt;
      for (std::size_t echo = 0; echo < line.ranges.size(); ++echo) {
        if (!wanted(line, echo, beam)) continue;
        if (!tilt) tilt = curve_->at(time);
        if (!tilt) {
          ++counts.untilted;
          continue;
        }
        const Channel& channel = line.ranges[echo];
        const double range =
            1e-3 * (double{channel.scale} * channel.values[beam] + double{channel.offset});
        if (range < settings_.range_min || range > settings_.range_max) {
          ++counts.out_of_range;
          continue;
        }
        const Eigen::Vector3f at = mount_.point(range, angle, *tilt).cast<float>();
        points.push_back({at, static_cast<float>(*tilt), static_cast<float>(range),
                          remission(line, echo, beam), time, static_cast<std::int32_t>(beam),
                          line.number, static_cast<std::int32_t>(echo + 1)});
      }
    }
    return points;
  }

  // Of the beam next to it where the device sent the remission of another revolution.
  static float remission(const Line& line, std::size_t echo, std::size_t beam) {
    if (echo >= line.remission.size()) return 0.0F;
    const Channel& ranges = line.ranges[echo];
    const Channel& channel = line.remission[echo];
    auto at = static_cast<std::int64_t>(beam);
    if (channel.start != ranges.start && channel.step != 0)
      at += std::lround(static_cast<double>(ranges.start - channel.start) / channel.step);
    if (at < 0 || at >= static_cast<std::int64_t>(channel.values.size())) return 0.0F;
    return channel.scale * static_cast<float>(channel.values[static_cast<std::size_t>(at)]) +
           channel.offset;
  }

  [[nodiscard]] Cloud gathered_into_cloud(const std::vector<std::vector<Point>>& lines) const {
    Index n = 0;
    for (const auto& line : lines) n += static_cast<Index>(line.size());
    Points positions(3, n);
    Eigen::VectorXi beam(n);
    Eigen::VectorXi number(n);
    Eigen::VectorXi echo(n);
    Eigen::VectorXf tilt(n);
    Eigen::VectorXf range(n);
    Eigen::VectorXf intensity(n);
    Eigen::VectorXd time(n);
    const std::int32_t first = lines_.empty() ? 0 : lines_.front().line->number;
    Index at = 0;
    for (const auto& line : lines)
      for (const Point& point : line) {
        positions.col(at) = point.at;
        beam[at] = point.beam;
        number[at] = point.line - first;
        echo[at] = point.echo;
        tilt[at] = point.tilt;
        range[at] = point.range;
        intensity[at] = point.intensity;
        time[at++] = point.time;
      }
    Cloud cloud = Cloud(std::move(positions))
                      .with(column::kBeam, Column(std::move(beam)))
                      .with(column::kLine, Column(std::move(number)))
                      .with(column::kTilt, Column(std::move(tilt)))
                      .with(column::kTime, Column(std::move(time)))
                      .with("range", Column(std::move(range)))
                      .with(column::kSensor, Column(VectorXu8(VectorXu8::Zero(n))))
                      .with_sensors({{settings_.name, mount_.sensor(curve_->middle())}});
    const auto any = [&](auto&& test) {
      return std::any_of(lines_.begin(), lines_.end(),
                         [&](const Timed& t) { return test(*t.line); });
    };
    if (any([](const Line& line) { return !line.remission.empty(); }))
      cloud = cloud.with(column::kIntensity, Column(std::move(intensity)));
    if (any([](const Line& line) { return line.ranges.size() > 1; }))
      cloud = cloud.with("echo", Column(std::move(echo)));
    return cloud;
  }

  const SweepSettings& settings_;
  Mount mount_;
  std::vector<Timed> lines_;
  std::optional<TiltCurve> curve_;
  double zero_ = 0.0;
  bool triggered_ = false;
};

}  // namespace

Eigen::Matrix3d axis_turn(Mounting mounting, double tilt) {
  const bool plate = mounting == Mounting::plate;
  const Eigen::Vector3d axis = plate ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  return Eigen::AngleAxisd(tilt, axis).toRotationMatrix();
}

Eigen::Matrix3d misalignment_turn(const Eigen::Vector3d& angles) {
  return (Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Mount::Mount(Mounting mounting, const Calibration& calibration)
    : mounting_(mounting), lever_(calibration.lever) {
  const Eigen::Matrix3d turn = misalignment_turn(calibration.misalignment);
  right_ = turn * Eigen::Vector3d::UnitX();
  ahead_ =
      turn * (mounting == Mounting::plate ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ());
}

Pose Mount::sensor(double tilt) const {
  Pose pose = Pose::Identity();
  pose.linear().col(0) = right_;
  pose.linear().col(1) = ahead_;
  pose.linear().col(2) = right_.cross(ahead_);
  pose.translation() = turned(lever_, tilt);
  return pose;
}

double beam_delay(double angle, double frequency) {
  constexpr double kFirst = -5.0 * std::numbers::pi / 180.0;
  return (angle - kFirst) / (2.0 * std::numbers::pi * frequency);
}

Cloud make_sweep(const LineGatherer& lines, const SweepSettings& settings, SweepCounts& counts,
                 Context& context) {
  return Sweep(lines, settings).cloud(counts, context);
}

}  // namespace velum::lms511
