// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "graph/diagnostic.hpp"

namespace velum::graph {

/// "graph.toml:14:3", or the file alone when the mistake has no line.
[[nodiscard]] std::string place_of(const Diagnostic& diagnostic);

}  // namespace velum::graph
