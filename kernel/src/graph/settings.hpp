// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "graph/diagnostic.hpp"
#include "graph/toml.hpp"
#include "graph/units.hpp"
#include "velum/parameter.hpp"

namespace velum::graph {

/// The value of a parameter in SI units; type, unit and range are checked. A mistake is reported
/// and gives an unset Setting. Relative lengths stay relative: resolve() is for when the input is
/// known.
[[nodiscard]] Setting parse_setting(const Parameter& parameter, const toml::Node& value,
                                    const Units& units, const Reporter& report);

/// The same for a value written without a file: "5 mm", "0.05", "[0, 0, 1]", "true", "largest".
/// Bare lengths are metres. Throws Error (Fault::graph).
[[nodiscard]] Setting parse_setting_text(const Parameter& parameter, std::string_view text);

/// With relative lengths in metres, `spacing` and `diagonal` [m] being those of the input that the
/// parameter is relative to, and the range checked again. Throws Error (Fault::graph).
[[nodiscard]] Setting resolve(const Parameter& parameter, const Setting& setting, double spacing,
                              double diagonal);
/// Does resolve() need to know spacing or diagonal? They cost a neighbour search.
[[nodiscard]] bool is_relative(const Setting& setting);

/// "above 0 m", "between 0 and 1", "at least 3"; "" for any.
[[nodiscard]] std::string describe(const Parameter& parameter, const Range& range);
/// What a value must be: "a length such as \"5 mm\"", "one of: a, b".
[[nodiscard]] std::string describe_type(const Parameter& parameter);
/// As TOML, with units written out; parse_setting() gives the same setting again.
[[nodiscard]] std::string to_toml(const Parameter& parameter, const Setting& setting);

}  // namespace velum::graph
