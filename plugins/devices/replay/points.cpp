// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "points.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include "formats/lines.hpp"
#include "formats/text.hpp"

namespace velum::replay {
namespace {

// A beam along the axis does not move with the plate.
bool on_axis(const Eigen::Vector3d& p) {
  constexpr double kNear = 1e-3;
  return std::hypot(p.y(), p.z()) < kNear * p.norm();
}

// Tilts that are not known are those of the beam before, or of the next known one at the beginning.
void fill(Eigen::VectorXf& tilt) {
  for (Index i = 1; i < tilt.size(); ++i)
    if (std::isnan(tilt[i])) tilt[i] = tilt[i - 1];
  for (Index i = tilt.size() - 1; i-- > 0;)
    if (std::isnan(tilt[i])) tilt[i] = tilt[i + 1];
  if (tilt.size() > 0 && std::isnan(tilt[0])) tilt.setZero();
}

}  // namespace

bool is_points(const std::filesystem::path& path) {
  constexpr std::size_t kLooked = 8192;
  std::string head(kLooked, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  for (std::string_view rest = head; !rest.empty();) {
    const std::string_view line = formats::trimmed(formats::take_line(rest));
    if (!formats::is_data(line, true)) continue;
    const auto words = formats::words_of(line);
    return words.size() >= 3 && std::all_of(words.begin(), words.begin() + 3, [](auto word) {
             return formats::as_real(word).has_value();
           });
  }
  return false;
}

Cloud read_points(const std::filesystem::path& path, double unit, const std::string& sensor,
                  Context& context) {
  formats::Source source(path);
  formats::ReadOptions options;
  options.unit = unit;
  const Cloud read = formats::read_text(source, options, context);
  const Index n = read.size();
  Eigen::VectorXf tilt(n);
  Eigen::VectorXf range(n);
  Eigen::VectorXi beam(n);
  Eigen::VectorXi line(n);
  double last = -10.0;
  for (Index i = 0; i < n; ++i) {
    const Eigen::Vector3d p = read.positions().col(i).cast<double>() + read.origin();
    const double side = p.y() < 0.0 ? -1.0 : 1.0;  // beams below 0 and above 180 degrees
    tilt[i] = on_axis(p) ? std::numeric_limits<float>::quiet_NaN()
                         : static_cast<float>(std::atan2(side * p.z(), side * p.y()));
    range[i] = static_cast<float>(p.norm());
    double angle = std::atan2(side * std::hypot(p.y(), p.z()), p.x());
    if (angle < -0.5 * std::numbers::pi) angle += 2.0 * std::numbers::pi;
    const bool first = angle < last || i == 0;
    line[i] = i == 0 ? 0 : line[i - 1] + (first ? 1 : 0);
    beam[i] = first ? 0 : beam[i - 1] + 1;
    last = angle;
  }
  fill(tilt);
  Cloud cloud = read.with(column::kTilt, Column(std::move(tilt)))
                    .with("range", Column(std::move(range)))
                    .with(column::kBeam, Column(std::move(beam)))
                    .with(column::kLine, Column(std::move(line)))
                    .with(column::kSensor, Column(VectorXu8(VectorXu8::Zero(n))));
  return cloud.with_sensors({{sensor, Pose::Identity()}});
}

}  // namespace velum::replay
