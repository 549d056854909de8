// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "graph/toml.hpp"

namespace velum::graph::toml {

/// What an author meant who wrote what toml++ refuses with `reason` at `where`: text without quotes
/// (`size = 5 mm`), True, numbers that are too large or have a comma. The mistake has the place of
/// the whole value and says what to write; where it is none of these, it is what toml++ says.
[[nodiscard]] SyntaxError explained(std::string_view document, Region where,
                                    const std::string& reason);

}  // namespace velum::graph::toml
