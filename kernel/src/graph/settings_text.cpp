// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Settings in the other direction: to metres, to words, to TOML.
#include <numbers>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "graph/settings.hpp"
#include "velum/error.hpp"

namespace velum::graph {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::string unit_of(const Parameter& parameter) {
  switch (parameter.type) {
    case ParameterType::length:
    case ParameterType::point:
      return "m";
    case ParameterType::angle:
      return "deg";
    case ParameterType::duration:
      return "s";
    default:
      return parameter.unit;
  }
}

std::string bound(const Parameter& parameter, double x) {
  if (parameter.type == ParameterType::angle) return fmt::format("{:.6g}", x / kDegree);
  return fmt::format("{}", x);
}

std::string single_type(const Parameter& parameter) {
  switch (parameter.type) {
    case ParameterType::boolean:
      return "true or false";
    case ParameterType::integer:
      return "an integer";
    case ParameterType::number:
      return "a number";
    case ParameterType::text:
      return "text in quotes";
    case ParameterType::choice:
      return "one of the choices, in quotes";
    case ParameterType::length:
      return "a length such as \"5 mm\" or \"2 spacing\"";
    case ParameterType::angle:
      return "an angle such as \"7 deg\"";
    case ParameterType::duration:
      return "a time such as \"2 s\"";
    case ParameterType::vector:
      return "three numbers such as [0, 0, 1]";
    case ParameterType::point:
      return "a position such as [\"1 m\", \"0 m\", \"2 m\"]";
    case ParameterType::length_unit:
      return "a unit of length such as \"mm\"";
    case ParameterType::input_file:
    case ParameterType::output_file:
      return "the name of a file in quotes";
    case ParameterType::rows:
      return "an array of tables";
  }
  return "a value";
}

Setting metres(const Parameter& parameter, const Length& length, double spacing, double diagonal) {
  const bool of_spacing = length.of == Length::Of::spacing;
  const Length absolute(length.of == Length::Of::metres
                            ? length.value
                            : length.value * (of_spacing ? spacing : diagonal));
  if (!parameter.range.contains(absolute.value)) {
    std::string found = fmt::format("{} m", absolute.value);
    if (length.of != Length::Of::metres)
      found =
          fmt::format("{} {}, here {}", length.value, of_spacing ? "spacing" : "diagonal", found);
    throw Error(Fault::graph, fmt::format("'{}' is {}; it must be {}", parameter.name, found,
                                          describe(parameter, parameter.range)));
  }
  return {absolute};
}

std::string row_to_toml(const Parameter& parameter, const Setting& row) {
  const auto& cells = std::get<Setting::List>(row.value);
  std::vector<std::string> fields;
  for (std::size_t i = 0; i < parameter.fields.size() && i < cells.size(); ++i)
    if (cells[i].is_set())
      fields.push_back(parameter.fields[i].name + " = " + to_toml(parameter.fields[i], cells[i]));
  return fmt::format("{{ {} }}", fmt::join(fields, ", "));
}

std::string number_to_toml(const Parameter& parameter, double x) {
  switch (parameter.type) {
    case ParameterType::angle:
      return fmt::format("\"{} rad\"", x);
    case ParameterType::duration:
      return fmt::format("\"{} s\"", x);
    case ParameterType::point:
      return fmt::format("\"{} m\"", x);
    default:
      return fmt::format("{}", x);
  }
}

/// Writes any alternative of a Setting.
struct Writer {
  const Parameter& parameter;

  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return number_to_toml(parameter, value); }
  std::string operator()(const std::string& value) const { return toml::quoted(value); }
  std::string operator()(const Length& value) const {
    constexpr const char* kUnits[] = {"m", "spacing", "diagonal"};
    return fmt::format("\"{} {}\"", value.value, kUnits[static_cast<std::size_t>(value.of)]);
  }
  std::string operator()(const Setting::List& list) const {
    std::vector<std::string> entries;
    for (const Setting& entry : list)
      entries.push_back(parameter.type == ParameterType::rows ? row_to_toml(parameter, entry)
                                                              : to_toml(parameter, entry));
    return fmt::format("[{}]", fmt::join(entries, ", "));
  }
};

}  // namespace

Setting resolve(const Parameter& parameter, const Setting& setting, double spacing,
                double diagonal) {
  if (const auto* length = std::get_if<Length>(&setting.value))
    return metres(parameter, *length, spacing, diagonal);
  const auto* list = std::get_if<Setting::List>(&setting.value);
  if (list == nullptr) return setting;
  Setting::List resolved;
  const bool rows = parameter.type == ParameterType::rows;
  for (const Setting& entry : *list) {
    if (!rows) {
      resolved.push_back(resolve(parameter, entry, spacing, diagonal));
      continue;
    }
    Setting::List cells = std::get<Setting::List>(entry.value);
    for (std::size_t i = 0; i < cells.size() && i < parameter.fields.size(); ++i)
      cells[i] = resolve(parameter.fields[i], cells[i], spacing, diagonal);
    resolved.push_back({std::move(cells)});
  }
  return {std::move(resolved)};
}

bool is_relative(const Setting& setting) {
  if (const auto* length = std::get_if<Length>(&setting.value))
    return length->of != Length::Of::metres;
  const auto* list = std::get_if<Setting::List>(&setting.value);
  if (list == nullptr) return false;
  for (const Setting& entry : *list)
    if (is_relative(entry)) return true;
  return false;
}

std::string describe(const Parameter& parameter, const Range& range) {
  const bool low = range.low > -std::numeric_limits<double>::infinity();
  const bool high = range.high < std::numeric_limits<double>::infinity();
  std::string unit = unit_of(parameter);
  if (!unit.empty()) unit.insert(0, " ");
  const std::string low_text = bound(parameter, range.low);
  const std::string high_text = bound(parameter, range.high);
  const std::string low_words = (range.low_open ? "above " : "at least ") + low_text;
  const std::string high_words = (range.high_open ? "below " : "at most ") + high_text;
  if (low && high && !range.low_open && !range.high_open)
    return fmt::format("between {} and {}{}", low_text, high_text, unit);
  if (low && high) return fmt::format("{} and {}{}", low_words, high_words, unit);
  if (low) return low_words + unit;
  return high ? high_words + unit : "";
}

std::string describe_type(const Parameter& parameter) {
  return parameter.list ? "an array, each " + single_type(parameter) : single_type(parameter);
}

std::string to_toml(const Parameter& parameter, const Setting& setting) {
  return std::visit(Writer{parameter}, setting.value);
}

}  // namespace velum::graph
