// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>

#include "lms511/tilt.hpp"
#include "velum/files.hpp"

namespace velum::lms511 {
namespace {

bool take_number(std::string_view& text, double& number) {
  const std::size_t begin = text.find_first_not_of(" \t,;\r");
  if (begin == std::string_view::npos) return false;
  text.remove_prefix(begin);
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  if (result.ec != std::errc() || !std::isfinite(number)) return false;
  text.remove_prefix(static_cast<std::size_t>(result.ptr - text.data()));
  return true;
}

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \t\r") == std::string_view::npos;
}

}  // namespace

std::vector<TiltCurve::Knot> read_tilt_file(const std::filesystem::path& path) {
  const FileContent content(path, std::uint64_t{1} << 30U);
  std::vector<TiltCurve::Knot> knots;
  std::string_view rest = content.text();
  for (std::size_t number = 1; !rest.empty(); ++number) {
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    line = line.substr(0, line.find('#'));
    if (is_blank(line)) continue;
    TiltCurve::Knot knot;
    double degrees = 0.0;
    if (!take_number(line, knot.time) || !take_number(line, degrees) || !is_blank(line))
      throw Error(Fault::input, "expected a time [s] and an angle [deg]")
          .at(fmt::format("{}:{}", path.string(), number));
    knot.angle = degrees * std::numbers::pi / 180.0;
    knots.push_back(knot);
  }
  if (knots.empty())
    throw Error(Fault::input, "no line with a time and an angle").at(path.string());
  return knots;
}

}  // namespace velum::lms511
