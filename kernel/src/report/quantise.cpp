// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "report/quantise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

namespace velum::report {
namespace {

constexpr std::array<std::string_view, 4> kBookkeeping = {column::kBeam, column::kLine,
                                                          column::kTilt, column::kTime};

template <class T>
std::vector<double> as_doubles(const Column& column) {
  const auto from = column.vector<T>();
  std::vector<double> numbers(static_cast<std::size_t>(from.size()));
  for (Index i = 0; i < from.size(); ++i)
    numbers[static_cast<std::size_t>(i)] = static_cast<double>(from[i]);
  return numbers;
}

ViewColumn number_column(const std::string& name, const std::vector<double>& numbers) {
  ViewColumn made{.name = name, .unit = unit_of(name)};
  double lo = std::numeric_limits<double>::infinity();
  double hi = -lo;
  for (const double x : numbers) {
    if (!std::isfinite(x)) continue;
    lo = std::min(lo, x);
    hi = std::max(hi, x);
  }
  if (lo <= hi) {
    made.lo = lo;
    made.hi = hi;
  }
  // Halves, since the difference of two finite numbers may be infinite.
  const double half = 0.5 * made.hi - 0.5 * made.lo;
  std::vector<std::uint16_t> steps(numbers.size(), kNoNumber);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!std::isfinite(numbers[i])) continue;
    const double share = half > 0.0 ? (0.5 * numbers[i] - 0.5 * made.lo) / half : 0.0;
    steps[i] = static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.0, 1.0) * kNumberSteps));
  }
  made.data = Bytes::of(steps);
  return made;
}

std::vector<std::int64_t> integers_of(const std::string& name, const Column& column) {
  std::vector<std::int64_t> numbers(static_cast<std::size_t>(column.count()));
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = column.scalar() == Scalar::u8
                     ? std::int64_t{column.vector<std::uint8_t>()[static_cast<Index>(i)]}
                     : std::int64_t{column.vector<std::int32_t>()[static_cast<Index>(i)]};
  constexpr std::int64_t kUnknownSensor = 255;
  if (name == column::kSensor) std::ranges::replace(numbers, kUnknownSensor, std::int64_t{-1});
  return numbers;
}

}  // namespace

std::string unit_of(std::string_view column) {
  static const std::map<std::string_view, std::string> kUnits = {
      {"displacement", "m"}, {"distance", "m"},           {"height", "m"},
      {"incidence", "rad"},  {"normal_deviation", "rad"}, {"deviation", "m"}};
  const auto found = kUnits.find(column);
  return found == kUnits.end() ? "" : found->second;
}

void quantise_positions(const Cloud& cloud, View& view) {
  view.count = view.shown = static_cast<std::uint64_t>(cloud.size());
  view.origin = cloud.origin();
  view.sensors = cloud.sensors();
  const auto positions = cloud.positions();
  std::vector<std::uint16_t> steps(static_cast<std::size_t>(positions.size()));
  if (!cloud.empty()) {
    const Eigen::AlignedBox3f box = bounding_box(positions);
    view.lo = box.min().cast<double>();
    view.hi = box.max().cast<double>();
    Eigen::Vector3d scale;
    for (int axis = 0; axis < 3; ++axis) {
      const double range = view.hi[axis] - view.lo[axis];
      scale[axis] = range > 0.0 ? kPositionSteps / range : 0.0;
    }
    std::size_t at = 0;
    for (Index i = 0; i < positions.cols(); ++i)
      for (int axis = 0; axis < 3; ++axis)
        steps[at++] = static_cast<std::uint16_t>(
            std::lround((static_cast<double>(positions(axis, i)) - view.lo[axis]) * scale[axis]));
  }
  view.positions = Bytes::of(steps);
}

ViewColumn labels(const std::string& name, const std::vector<std::int64_t>& numbers) {
  ViewColumn made{.name = name, .unit = "", .label = true};
  const auto most = std::ranges::max_element(numbers);
  made.bits = most == numbers.end() || *most < std::numeric_limits<std::uint16_t>::max() ? 16 : 32;
  const auto fill = [&](auto none) {
    std::vector<decltype(none)> raw(numbers.size(), none);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (numbers[i] >= 0) raw[i] = static_cast<decltype(none)>(numbers[i]);
    made.data = Bytes::of(raw);
  };
  if (made.bits == 16)
    fill(std::numeric_limits<std::uint16_t>::max());
  else
    fill(std::numeric_limits<std::uint32_t>::max());
  return made;
}

std::vector<double> numbers_of(const Column& column) {
  switch (column.scalar()) {
    case Scalar::u8:
      return as_doubles<std::uint8_t>(column);
    case Scalar::i32:
      return as_doubles<std::int32_t>(column);
    case Scalar::f32:
      return as_doubles<float>(column);
    case Scalar::f64:
      break;
  }
  return as_doubles<double>(column);
}

std::optional<ViewColumn> quantise(const std::string& name, const Column& column) {
  if (column.width() != 1 || std::ranges::find(kBookkeeping, name) != kBookkeeping.end())
    return std::nullopt;
  const bool whole = column.scalar() == Scalar::u8 || column.scalar() == Scalar::i32;
  if (whole && name != column::kIntensity) return labels(name, integers_of(name, column));
  return number_column(name, numbers_of(column));
}

}  // namespace velum::report
