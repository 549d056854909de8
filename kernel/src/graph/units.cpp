// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "graph/units.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "velum/error.hpp"

namespace velum {
namespace {

// One of a unit is `times` / `per` of the SI unit: two numbers, so that 7 mm is 7 / 1000 rounded
// once, the same double as 0.007.
struct Unit {
  std::string_view name;
  double times;
  double per;
};
constexpr Unit kLengths[] = {{"m", 1, 1},         {"mm", 1, 1000},      {"cm", 1, 100},
                             {"km", 1000, 1},     {"um", 1, 1'000'000}, {"in", 254, 10'000},
                             {"ft", 3048, 10'000}};
constexpr Unit kAngles[] = {{"deg", std::numbers::pi, 180}, {"rad", 1, 1}};
constexpr Unit kDurations[] = {
    {"s", 1, 1}, {"ms", 1, 1000}, {"us", 1, 1'000'000}, {"min", 60, 1}, {"h", 3600, 1}};
constexpr Unit kBytes[] = {{"B", 1, 1},       {"kB", 1e3, 1},     {"MB", 1e6, 1},
                           {"GB", 1e9, 1},    {"KiB", 0x1p10, 1}, {"MiB", 0x1p20, 1},
                           {"GiB", 0x1p30, 1}};

const Unit* find_unit(std::span<const Unit> units, std::string_view name) {
  const auto found = std::ranges::find(units, name, &Unit::name);
  return found == units.end() ? nullptr : &*found;
}

std::optional<double> convert(std::span<const Unit> units, const graph::Amount& amount) {
  const Unit* unit = find_unit(units, amount.unit);
  if (unit == nullptr) return std::nullopt;
  return amount.number * unit->times / unit->per;
}

std::vector<std::string> names_of(std::span<const Unit> units) {
  std::vector<std::string> names;
  for (const Unit& unit : units) names.emplace_back(unit.name);
  return names;
}

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace

LengthUnit length_unit(std::string_view name) {
  const Unit* unit = find_unit(kLengths, name);
  if (unit == nullptr)
    throw Error(Fault::graph, fmt::format("'{}' is no unit of length", name))
        .hint(fmt::format("known: {}", fmt::join(graph::length_units(), ", ")));
  return {std::string(name), unit->times / unit->per};
}

namespace graph {

std::optional<double> parse_number(std::string_view text) {
  const auto amount = parse_amount(text);
  if (!amount || !amount->unit.empty()) return std::nullopt;
  return amount->number;
}

std::optional<Amount> parse_amount(std::string_view text) {
  text = trim(text);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  Amount amount;
  const char* const end = text.data() + text.size();
  const auto [rest, fault] = std::from_chars(text.data(), end, amount.number);
  if (fault != std::errc() || !std::isfinite(amount.number)) return std::nullopt;
  text = trim({rest, static_cast<std::size_t>(end - rest)});
  for (const char c : text) {
    if (is_blank(c) && is_blank(amount.unit.back())) continue;
    amount.unit += is_blank(c) ? ' ' : c;
  }
  return amount;
}

std::optional<Length> to_length(const Amount& amount) {
  const double n = amount.number;
  if (amount.unit == "spacing") return spacings(n);
  if (amount.unit == "diagonal") return diagonals(n);
  if (amount.unit == "% spacing" || amount.unit == "%spacing") return spacings(n / 100);
  if (amount.unit == "% diagonal" || amount.unit == "%diagonal") return diagonals(n / 100);
  if (const auto metres = convert(kLengths, amount)) return Length(*metres);
  return std::nullopt;
}

std::optional<double> to_angle(const Amount& amount) {
  return convert(kAngles, amount);
}
std::optional<double> to_duration(const Amount& amount) {
  return convert(kDurations, amount);
}
std::optional<double> to_bytes(const Amount& amount) {
  return convert(kBytes, amount);
}

std::optional<std::uint64_t> parse_memory(std::string_view text) {
  constexpr double kMost = 1e18;
  const auto amount = parse_amount(text);
  const auto bytes = amount ? to_bytes(*amount) : std::nullopt;
  if (!bytes || !(*bytes >= 1.0) || *bytes > kMost) return std::nullopt;
  return static_cast<std::uint64_t>(*bytes);
}

double in_metres(double number, const LengthUnit& unit) {
  return convert(kLengths, {number, unit.name}).value_or(number * unit.metres);
}

const std::vector<std::string>& length_units() {
  static const std::vector<std::string> names = names_of(kLengths);
  return names;
}
const std::vector<std::string>& relative_units() {
  static const std::vector<std::string> names = {"spacing", "diagonal", "% spacing", "% diagonal"};
  return names;
}
const std::vector<std::string>& angle_units() {
  static const std::vector<std::string> names = names_of(kAngles);
  return names;
}
const std::vector<std::string>& duration_units() {
  static const std::vector<std::string> names = names_of(kDurations);
  return names;
}
const std::vector<std::string>& byte_units() {
  static const std::vector<std::string> names = names_of(kBytes);
  return names;
}

}  // namespace graph
}  // namespace velum
