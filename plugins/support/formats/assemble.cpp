// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/assemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/attributes.hpp"
#include "formats/lines.hpp"
#include "formats/positions.hpp"

namespace velum::formats {
namespace {

constexpr std::string_view kSensorMark = "velum sensor ";
/// Rounding of coordinates that is worth a warning [m]: a fortieth of a scanner's noise.
constexpr double kTolerableRounding = 1e-4;

Axes find_axes(const Source& source, const Records& records, const ReadOptions& options) {
  constexpr std::string_view kNames[] = {"x", "y", "z"};
  Axes axes;
  for (std::size_t i = 0; i < 3; ++i) {
    axes[i] = {records.find(kNames[i]), 0, options.unit};
    if (axes[i].field == nullptr || axes[i].field->width != 1)
      throw Error(Fault::input, fmt::format("no column '{}', which a cloud needs", kNames[i]))
          .at(source.name());
  }
  if (!options.left_handed) return axes;
  Axes turned{axes[2], axes[0], axes[1]};
  turned[1].factor = -options.unit;
  return turned;
}

/// x, y, z of a left-handed file are y (reversed), z and x here.
Pose right_handed(const Pose& pose) {
  Eigen::Matrix3d swap;
  swap << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, 1.0, 0.0;
  Pose result = Pose::Identity();
  result.linear() = swap * pose.linear() * swap.transpose();
  result.translation() = swap * pose.translation();
  return result;
}

std::vector<Sensor> placed(std::vector<Sensor> sensors, const ReadOptions& options) {
  for (Sensor& sensor : sensors) {
    sensor.pose.translation() *= options.unit;
    if (options.left_handed) sensor.pose = right_handed(sensor.pose);
  }
  return sensors;
}

void report(const Source& source, const Positions& positions, const Records& records,
            NotFinite not_finite, Context& context) {
  if (not_finite == NotFinite::refuse && positions.dropped > 0)
    throw Error(Fault::input, fmt::format("{} of {} vertices have no finite coordinates",
                                          positions.dropped, records.count))
        .at(source.name());
  if (not_finite == NotFinite::drop)
    context.measure("dropped", static_cast<double>(positions.dropped), "", Better::lower);
  if (positions.dropped > 0)
    context.warn(fmt::format("{}: {} of {} points have no finite coordinates and were dropped",
                             source.name(), positions.dropped, records.count));
  if (positions.rounding > kTolerableRounding)
    context.warn(
        fmt::format("{}: the cloud is so large that single precision moves its points by "
                    "up to {:.2g} m",
                    source.name(), positions.rounding));
}

}  // namespace

Cloud assemble(const Source& source, const Records& records, const ReadOptions& options,
               NotFinite not_finite, Context& context) {
  if (records.count > std::numeric_limits<std::int32_t>::max())
    throw Error(Fault::input,
                fmt::format("{} points; at most 2147483647 are possible", records.count))
        .at(source.name());
  Positions positions = read_positions(records, find_axes(source, records, options), context);
  report(source, positions, records, not_finite, context);
  const Kept kept{positions.points.cols(), positions.dropped > 0 ? positions.kept.data() : nullptr};
  const std::string used[] = {"x", "y", "z"};
  Columns columns = read_attributes(records, kept, used, options.left_handed, context);
  Cloud cloud(std::move(positions.points), positions.origin);
  for (auto& [name, column] : columns) cloud = cloud.with(name, std::move(column));
  return cloud.with_sensors(placed(records.sensors, options));
}

std::string sensor_line(const Sensor& sensor, double unit) {
  const Eigen::Quaterniond turn(sensor.pose.linear());
  const Eigen::Vector3d place = sensor.pose.translation() / unit;
  std::string name = sensor.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c >= '\0' && c < ' '; }, ' ');
  return fmt::format("{}{} {} {} {} {} {} {} {}", kSensorMark, place.x(), place.y(), place.z(),
                     turn.w(), turn.x(), turn.y(), turn.z(), name);
}

void read_sensor_line(std::string_view comment, std::vector<Sensor>& sensors) {
  comment = trimmed(comment);
  constexpr std::size_t kMostSensors = 256;  // the sensor column is a byte
  if (!comment.starts_with(kSensorMark) || sensors.size() >= kMostSensors) return;
  comment.remove_prefix(kSensorMark.size());
  std::array<double, 7> values{};
  for (double& value : values) {
    const auto number = as_real(take_word(comment));
    if (!number) return;
    value = *number;
  }
  if (const auto pose = pose_of(values)) sensors.push_back({std::string(trimmed(comment)), *pose});
}

std::optional<Pose> pose_of(const std::array<double, 7>& values) {
  const Eigen::Quaterniond turn(values[3], values[4], values[5], values[6]);
  const double norm = turn.norm();
  if (!(norm > 1e-6 && norm < 1e6)) return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i)
    if (!(std::abs(values[i]) <= kLargestCoordinate)) return std::nullopt;
  Pose pose = Pose::Identity();
  pose.linear() = turn.normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(values[0], values[1], values[2]);
  return pose;
}

}  // namespace velum::formats
