// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "run/json.hpp"

namespace velum::run {

/// What differs between two records of one graph, one line each: status, hashes of inputs, results
/// and files. Times and measures of the machine do not count. Versions of stages and plugins are
/// named where results differ, since they may be why.
std::vector<std::string> compare(const Json& before, const Json& after);

}  // namespace velum::run
