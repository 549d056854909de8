// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "run/json.hpp"
#include "velum/values.hpp"

namespace velum::run {

/// What a record says of a value: its type, its hash, how much there is of what.
Json summarise(const Value& value);
/// How much there is of what, as a line for people: "412,345 points, 12 columns".
std::string in_words(const Json& summary);
/// The number that tells whether something was lost: points, triangles or rows; -1: has none.
double amount(const Json& summary);

}  // namespace velum::run
