// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "run/json.hpp"
#include "velum/parameter.hpp"

namespace velum::run {

/// A parameter's value in SI units: null, a boolean, number or text, an array, an object for a row
/// of a small table. A length that is not resolved yet is text: "2 spacing".
Json to_json(const Parameter& parameter, const Setting& setting);
/// The setting that to_json() made this of; throws Error (Fault::input) for any other JSON.
Setting from_json(const Parameter& parameter, const Json& json);

/// All settings by the names of their parameters.
Json to_json(const std::vector<Parameter>& parameters, const std::vector<Setting>& settings);
std::vector<Setting> from_json(const std::vector<Parameter>& parameters, const Json& json);

}  // namespace velum::run
