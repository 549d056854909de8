// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "velum/values.hpp"

namespace velum::test {

/// What is wrong with a value, in a few words ("a normal that is not of unit length"), or "".
std::string unsound(const Value& value);

}  // namespace velum::test
