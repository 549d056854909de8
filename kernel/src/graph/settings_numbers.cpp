// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Numbers of settings: shares, angles, times, lengths, positions, and their ranges.
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "graph/setting_parser.hpp"

namespace velum::graph {

Setting SettingParser::integer(const toml::Node& value) const {
  if (!value.is(Kind::integer))
    return wrong_type(value, value.is(Kind::number) ? "write it without a point" : "");
  if (!in_range(static_cast<double>(value.integer), value)) return {};
  // Stages hold an integer in 32 bits unless its range says that it may be larger.
  constexpr std::int64_t kLargest = std::numeric_limits<std::int32_t>::max();
  const double high = parameter_.range.high;
  if ((value.integer >= -kLargest && value.integer <= kLargest) ||
      (std::isfinite(high) && high > static_cast<double>(kLargest)))
    return {value.integer};
  report_.error("E0206", value.where,
                fmt::format("{} is {}; it must be between {} and {}", called(), value.integer,
                            -kLargest, kLargest));
  return {};
}

std::optional<double> SettingParser::number(const toml::Node& value) const {
  if (value.is(Kind::integer)) return static_cast<double>(value.integer);
  if (value.is(Kind::number)) return value.number;
  const auto amount = value.is(Kind::string) ? parse_amount(value.text) : std::nullopt;
  if (!amount) {
    wrong_type(value);
    return std::nullopt;
  }
  if (amount->unit.empty() || amount->unit == parameter_.unit) return amount->number;
  if (amount->unit == "%" && parameter_.unit.empty()) return amount->number / 100;
  const std::string unit = parameter_.unit.empty() ? "%" : parameter_.unit;
  unknown_unit(value, amount->unit, "this number", {unit});
  return std::nullopt;
}

void SettingParser::unknown_unit(const toml::Node& value, const std::string& unit,
                                 std::string_view of, const std::vector<std::string>& known) const {
  report_.error("E0205", value.where, fmt::format("{}: '{}' is no unit of {}", called(), unit, of),
                did_you_mean(unit, known), known_list(known));
}

std::optional<double> SettingParser::quantity(const toml::Node& value, Convert convert,
                                              const std::vector<std::string>& known,
                                              std::string_view of, const char* bare) const {
  if (value.is(Kind::integer)) return convert({static_cast<double>(value.integer), bare});
  if (value.is(Kind::number)) return convert({value.number, bare});
  auto amount = value.is(Kind::string) ? parse_amount(value.text) : std::nullopt;
  if (!amount) {
    wrong_type(value);
    return std::nullopt;
  }
  if (amount->unit.empty()) amount->unit = bare;
  const auto result = convert(*amount);
  if (!result) unknown_unit(value, amount->unit, of, known);
  return result;
}

Setting SettingParser::checked(std::optional<double> number, const toml::Node& value) const {
  if (!number || !in_range(*number, value)) return {};
  return {*number};
}

Setting SettingParser::length(const toml::Node& value) const {
  const auto length = to_length(value, true);
  if (!length) return {};
  const bool relative = length->of != Length::Of::metres;
  // Of a relative length only the sign is known yet.
  const Range sign{.low = parameter_.range.low, .low_open = parameter_.range.low_open};
  if (relative && (parameter_.range.low < 0 || sign.contains(length->value) ||
                   (parameter_.range.low > 0 && length->value > 0)))
    return {*length};
  if (!in_range(length->value, value)) return {};
  return {*length};
}

std::optional<Length> SettingParser::to_length(const toml::Node& value, bool relative) const {
  if (value.is(Kind::integer)) return bare_length(static_cast<double>(value.integer), value);
  if (value.is(Kind::number)) return bare_length(value.number, value);
  const auto amount = value.is(Kind::string) ? parse_amount(value.text) : std::nullopt;
  if (!amount) {
    wrong_type(value);
    return std::nullopt;
  }
  if (amount->unit.empty()) return bare_length(amount->number, value);
  const auto length = graph::to_length(*amount);
  if (length && (relative || length->of == Length::Of::metres)) return length;
  auto known = length_units();
  if (relative) known.insert(known.end(), relative_units().begin(), relative_units().end());
  unknown_unit(value, amount->unit, relative ? "length" : "a position", known);
  return std::nullopt;
}

std::optional<Length> SettingParser::bare_length(double number, const toml::Node& value) const {
  if (units_.length) return Length(in_metres(number, *units_.length));
  report_.error("E0205", value.where, fmt::format("{}: {} has no unit", called(), number),
                fmt::format("write \"{} mm\", or units = \"mm\" at the top of the file", number));
  return std::nullopt;
}

Setting SettingParser::triple(const toml::Node& value) const {
  const bool point = parameter_.type == ParameterType::point;
  if (!value.is(Kind::array)) return wrong_type(value);
  if (value.items.size() != 3) {
    report_.error("E0204", value.where,
                  fmt::format("{} has {} entries; expected {}", called(), value.items.size(),
                              describe_type(parameter_)));
    return {};
  }
  Setting::List entries;
  for (const toml::Node& item : value.items) {
    std::optional<double> entry;
    if (!point)
      entry = number(item);
    else if (const auto length = to_length(item, false))
      entry = length->value;
    if (!entry || !in_range(*entry, item)) return {};
    entries.push_back({*entry});
  }
  return {std::move(entries)};
}

bool SettingParser::in_range(double x, const toml::Node& value) const {
  const bool finite = std::isfinite(x);
  if (finite && parameter_.range.contains(x)) return true;
  const std::string found = value.is(Kind::string)    ? fmt::format("\"{}\"", value.text)
                            : value.is(Kind::integer) ? fmt::format("{}", value.integer)
                                                      : fmt::format("{}", value.number);
  report_.error("E0206", value.where,
                fmt::format("{} is {}; it must be {}", called(), found,
                            finite ? describe(parameter_, parameter_.range) : "a finite number"));
  return false;
}

}  // namespace velum::graph
