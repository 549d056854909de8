// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "velum/cloud.hpp"

namespace velum {
namespace {

/// Entry of a `sensor` column for points that no known sensor saw.
constexpr std::uint8_t kNoSensor = 255;

/// Number of `sensor` in `sensors`, where it is added unless an equal one is there already.
std::uint8_t number_of(const Sensor& sensor, std::vector<Sensor>& sensors) {
  const auto found = std::find_if(sensors.begin(), sensors.end(), [&](const Sensor& other) {
    return other.name == sensor.name && other.pose.matrix() == sensor.pose.matrix();
  });
  if (found != sensors.end()) return static_cast<std::uint8_t>(found - sensors.begin());
  if (sensors.size() == kNoSensor)
    throw Error(Fault::stage, "the merged cloud would have more than 255 sensors");
  sensors.push_back(sensor);
  return static_cast<std::uint8_t>(sensors.size() - 1);
}

/// Numbers in `sensors` of those that saw the points of `cloud`.
void renumber(const Cloud& cloud, std::vector<Sensor>& sensors, Eigen::Ref<VectorXu8> to) {
  constexpr std::size_t kNumbers = 256;  // that a `sensor` column can hold
  std::vector<std::uint8_t> numbers;
  for (const Sensor& sensor : cloud.sensors()) numbers.push_back(number_of(sensor, sensors));
  numbers.resize(std::max(kNumbers, numbers.size()), kNoSensor);
  if (!cloud.has(column::kSensor)) {
    to.setConstant(numbers.front());
    return;
  }
  const auto old = cloud.column(column::kSensor).vector<std::uint8_t>();
  for (Index i = 0; i < old.size(); ++i) to(i) = numbers[old(i)];
}

/// The column `name` of all clouds; empty when one of them lacks it.
std::optional<Column> joined(std::span<const Cloud> clouds, const std::string& name) {
  const Column& first = clouds.front().column(name);
  for (const Cloud& cloud : clouds) {
    if (!cloud.has(name)) return std::nullopt;
    const Column& column = cloud.column(name);
    if (column.scalar() == first.scalar() && column.width() == first.width()) continue;
    throw Error(Fault::stage,
                fmt::format("column '{}' has type {}x{} in one cloud and {}x{} in another", name,
                            name_of(first.scalar()), first.width(), name_of(column.scalar()),
                            column.width()))
        .hint("convert or remove the column before merging");
  }
  std::vector<Column> parts;
  for (const Cloud& cloud : clouds) parts.push_back(cloud.column(name));
  return Column::concatenate(parts);
}

Cloud merged(std::span<const Cloud> clouds) {
  const Cloud& first = clouds.front();
  std::vector<Column> positions;
  for (const Cloud& cloud : clouds)
    positions.push_back(cloud.with_origin(first.origin()).position_column());
  Cloud result(Column::concatenate(positions), first.origin());
  for (const auto& [name, column] : first.columns()) {
    if (name == column::kSensor) continue;
    if (auto all = joined(clouds, name)) result = result.with(name, std::move(*all));
  }
  return result;
}

}  // namespace

Cloud merge(std::span<const Cloud> clouds) {
  // Clouds without points say nothing about columns or origin; their sensors are kept.
  std::vector<Cloud> filled;
  for (const Cloud& cloud : clouds)
    if (!cloud.empty()) filled.push_back(cloud);
  if (filled.empty()) return clouds.empty() ? Cloud() : clouds.front();

  Cloud result = filled.size() == 1 ? filled.front() : merged(filled);
  std::vector<Sensor> sensors;
  VectorXu8 numbers(result.size());
  Index at = 0;
  for (const Cloud& cloud : clouds) {
    renumber(cloud, sensors, numbers.segment(at, cloud.size()));
    at += cloud.size();
  }
  if (sensors.empty()) return result.without(column::kSensor);
  // One sensor that saw every point needs no column.
  if (numbers.maxCoeff() > 0 || filled.front().has(column::kSensor))
    result = result.with(column::kSensor, Column(std::move(numbers)));
  return result.with_sensors(std::move(sensors));
}

}  // namespace velum
