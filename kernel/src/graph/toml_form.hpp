// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace velum::graph::toml {

/// Refuses what toml++ 3.3.0 does not survive or wrongly accepts: documents that are too large, not
/// UTF-8, nested too deeply, with control characters, with letters outside ASCII where none may be,
/// headers and keys of a wrong form, brackets that do not match. What passes may still be no TOML.
/// Throws SyntaxError.
void check_form(std::string_view document);

}  // namespace velum::graph::toml
