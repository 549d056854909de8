// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "velum/api.hpp"

namespace velum {

/// A length: absolute [m], or a multiple of a cloud's point spacing (median nearest-neighbour
/// distance) or of its bounding box's diagonal. A stage that runs sees metres only.
struct Length {
  enum class Of : std::uint8_t { metres, spacing, diagonal };
  double value = 0.0;
  Of of = Of::metres;
  constexpr Length() = default;
  constexpr Length(double metres) : value(metres) {}  // NOLINT(google-explicit-constructor)
  constexpr Length(double factor, Of relative_to) : value(factor), of(relative_to) {}
  constexpr operator double() const { return value; }  // NOLINT(google-explicit-constructor)
  bool operator==(const Length&) const = default;
};
/// "2 spacing" as a default: `Length size = velum::spacings(2);`
constexpr Length spacings(double factor) {
  return {factor, Length::Of::spacing};
}
/// "1 % diagonal" as a default: `Length size = velum::diagonals(0.01);`
constexpr Length diagonals(double factor) {
  return {factor, Length::Of::diagonal};
}

/// An angle [rad]; bare numbers in a graph are degrees.
struct Angle {
  double radians = 0.0;
  constexpr operator double() const { return radians; }  // NOLINT(google-explicit-constructor)
};
/// A time span [s].
struct Duration {
  double seconds = 0.0;
  constexpr operator double() const { return seconds; }  // NOLINT(google-explicit-constructor)
};
/// A place [m], in absolute coordinates.
struct Place {
  Eigen::Vector3d metres = Eigen::Vector3d::Zero();
};
/// The unit of lengths in a file; the graph's `units` unless the node says otherwise.
struct LengthUnit {
  std::string name = "m";
  double metres = 1.0;
};
/// A file to read; relative to the graph's folder. Its content is part of the result's key.
struct InputFile {
  std::filesystem::path path;
};
/// A file to write; relative to the run's output folder.
struct OutputFile {
  std::filesystem::path path;
};

/// The length unit called `name` ("m", "mm", "cm", "km", "um", "in", "ft"); throws Error.
VELUM_API LengthUnit length_unit(std::string_view name);

/// A parameter's value, in SI units. A vector or place is a list of three numbers, a row of a small
/// table a list in the order of its fields; monostate: not set.
struct Setting {
  using List = std::vector<Setting>;
  std::variant<std::monostate, bool, std::int64_t, double, std::string, Length, List> value;

  [[nodiscard]] bool is_set() const { return value.index() != 0; }
  bool operator==(const Setting& other) const;
};
inline bool Setting::operator==(const Setting& other) const {  // defaulted, it stops clang 14
  return value == other.value;
}

enum class ParameterType : std::uint8_t {
  boolean,
  integer,
  number,
  text,
  choice,
  length,
  angle,
  duration,
  vector,
  point,
  length_unit,
  input_file,
  output_file,
  rows
};
/// "boolean", "integer", ... as in `velum describe --json`.
VELUM_API std::string_view name_of(ParameterType type);

/// Allowed numbers, in SI units.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;
  [[nodiscard]] bool contains(double x) const {
    return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high);
  }
  [[nodiscard]] bool unbounded() const { return contains(-1e308 * 10) && contains(1e308 * 10); }
};
constexpr Range above(double low) {
  return {.low = low, .low_open = true};
}
constexpr Range at_least(double low) {
  return {.low = low};
}
constexpr Range between(double low, double high) {
  return {.low = low, .high = high};
}
constexpr Range anything() {
  return {};
}

/// One allowed value of a choice.
struct ChoiceOption {
  std::string name;
  std::string doc;
};

/// All that is known of a parameter.
struct Parameter {
  std::string name;
  std::string doc;
  ParameterType type = ParameterType::number;
  bool list = false;                   ///< an array of these
  bool optional = false;               ///< may stay unset: the stage then does without
  bool required = false;               ///< must be given in the graph
  bool advanced = false;               ///< of no interest to a beginner
  std::string unit;                    ///< of a number; lengths, angles, durations have their own
  Range range;                         ///< of each number in it
  std::vector<ChoiceOption> choices;   ///< of a choice
  std::vector<Parameter> fields;       ///< of a small table
  std::string relative_to;             ///< input whose spacing and diagonal count; empty: the first
  std::vector<std::string> old_names;  ///< still understood
  Setting initial;                     ///< the default
  std::function<void(void* stage, const Setting&)> set;
};

}  // namespace velum
