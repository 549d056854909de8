// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "scene/scan.hpp"

#include <cmath>
#include <numbers>

#include "scene/ranges.hpp"

namespace velum::scene {
namespace {

struct Return {
  float x, y, z;
  float tilt;
  std::int32_t label;
  std::int32_t beam;
  double time;
};

// Lines begin one period apart; a beam is measured when the mirror has turned so far.
double time_of(const Scanner& scanner, Index line, double angle) {
  const double turned = (angle - scanner.beam_from) / (2.0 * std::numbers::pi);
  return scanner.period * (static_cast<double>(line) + turned);
}

Index steps(double from, double to, double step) {
  return static_cast<Index>(std::floor((to - from) / step + 1e-9)) + 1;
}

Cloud gather(const std::vector<std::vector<Return>>& lines, const Scanner& scanner) {
  std::size_t count = 0;
  for (const auto& line : lines) count += line.size();
  const auto n = static_cast<Index>(count);
  Points positions(3, n);
  Eigen::VectorXi label(n);
  Eigen::VectorXi beam(n);
  Eigen::VectorXi number(n);
  Eigen::VectorXf tilt(n);
  Eigen::VectorXd time(n);
  Index at = 0;
  for (std::size_t line = 0; line < lines.size(); ++line)
    for (const Return& one : lines[line]) {
      positions.col(at) << one.x, one.y, one.z;
      label[at] = one.label;
      beam[at] = one.beam;
      number[at] = static_cast<std::int32_t>(line);
      time[at] = one.time;
      tilt[at++] = one.tilt;
    }
  Cloud cloud = Cloud(std::move(positions))
                    .with(column::kLabel, Column(std::move(label)))
                    .with(column::kBeam, Column(std::move(beam)))
                    .with(column::kLine, Column(std::move(number)))
                    .with(column::kTilt, Column(std::move(tilt)))
                    .with(column::kSensor, Column(VectorXu8(VectorXu8::Zero(n))))
                    .with_sensors({{scanner.name, Pose::Identity()}});
  if (scanner.period > 0.0) cloud = cloud.with(column::kTime, Column(std::move(time)));
  return cloud;
}

}  // namespace

Cloud scan(const Scene& scene, const Scanner& scanner, const Random& random, Context& context) {
  const RangeFinder finder(scene, scanner);
  const Index tilts = steps(scanner.tilt_from, scanner.tilt_to, scanner.tilt_step);
  const Index lines = tilts * scanner.repeats;
  const Index beams = steps(scanner.beam_from, scanner.beam_to, scanner.beam_step);
  std::vector<std::vector<Return>> returns(static_cast<std::size_t>(lines));
  parallel_for(context, lines, 16, [&](Index begin, Index end) {
    for (Index line = begin; line < end; ++line) {
      context.check();
      auto& own = returns[static_cast<std::size_t>(line)];
      own.reserve(static_cast<std::size_t>(beams));
      const double tilt =
          scanner.tilt_from + static_cast<double>(line / scanner.repeats) * scanner.tilt_step;
      for (Index i = 0; i < beams; ++i) {
        const double angle = scanner.beam_from + static_cast<double>(i) * scanner.beam_step;
        const Beam beam{angle, tilt, time_of(scanner, line, angle)};
        const auto echo =
            finder.measure(beam, random.split(static_cast<std::uint64_t>(line * beams + i)));
        if (!echo) continue;
        const Eigen::Vector3f at = (echo->range * beam.direction()).cast<float>();
        own.push_back({at.x(), at.y(), at.z(), static_cast<float>(tilt), echo->label,
                       static_cast<std::int32_t>(i), beam.time});
      }
    }
  });
  return gather(returns, scanner);
}

}  // namespace velum::scene
