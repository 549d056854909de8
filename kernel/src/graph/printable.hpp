// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace velum::graph {

/// Text of others that goes to a terminal, one cell a character: letters of UTF-8 as they are, tabs
/// as a blank, everything that steers a terminal or turns the direction of writing as "\x1B" or
/// "\u202E", bytes that are no UTF-8 as "\xFF".
[[nodiscard]] std::vector<std::string> printable_cells(std::string_view text);
/// The same in one piece; line ends stay.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace velum::graph
