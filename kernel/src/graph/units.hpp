// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "velum/parameter.hpp"

namespace velum::graph {

/// What bare numbers of a file mean. Bare angles are degrees, bare durations seconds; bare lengths
/// are a mistake unless the file says `units`.
struct Units {
  std::optional<LengthUnit> length;
};

/// A number with what follows it: "5 mm" is {5, "mm"}, "1 % diagonal" is {1, "% diagonal"}.
struct Amount {
  double number = 0.0;
  std::string unit;
};

/// The whole of `text` as a finite number, whatever the locale.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);
/// Nothing when `text` does not begin with a finite number. Runs of blanks in the unit become one.
[[nodiscard]] std::optional<Amount> parse_amount(std::string_view text);

/// In metres, or relative ("2 spacing", "1 % diagonal"); nothing when the unit is not known.
[[nodiscard]] std::optional<Length> to_length(const Amount& amount);
/// In radians ("deg", "rad").
[[nodiscard]] std::optional<double> to_angle(const Amount& amount);
/// In seconds ("us", "ms", "s", "min", "h").
[[nodiscard]] std::optional<double> to_duration(const Amount& amount);
/// In bytes ("B", "kB", "MB", "GB", "KiB", "MiB", "GiB").
[[nodiscard]] std::optional<double> to_bytes(const Amount& amount);
/// The whole of `text` as an amount of memory of at least a byte, such as "2 GB".
[[nodiscard]] std::optional<std::uint64_t> parse_memory(std::string_view text);
/// `number` of the unit in metres, rounded once.
[[nodiscard]] double in_metres(double number, const LengthUnit& unit);

[[nodiscard]] const std::vector<std::string>& length_units();
[[nodiscard]] const std::vector<std::string>& relative_units();
[[nodiscard]] const std::vector<std::string>& angle_units();
[[nodiscard]] const std::vector<std::string>& duration_units();
[[nodiscard]] const std::vector<std::string>& byte_units();

}  // namespace velum::graph
