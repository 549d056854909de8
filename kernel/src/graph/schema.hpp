// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "graph/catalog.hpp"

namespace velum::graph {

/// A JSON Schema (draft 7, which editors of TOML understand) of graphs with the stages of the
/// catalog: every parameter with its type, range, choices, default and description. Opens every
/// plugin; one that does not load is left out.
[[nodiscard]] std::string schema(Catalog& catalog);

}  // namespace velum::graph
