// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "file_kind.hpp"

namespace velum::app {

/// What the beginning of a file says it holds, whatever its name is; nothing where it may be text
/// or anything else. `size` is the whole file's [bytes].
std::optional<FileKind> kind_by_content(std::string_view beginning, std::uintmax_t size);
/// Four rows of four numbers, the last one 0 0 0 1.
bool is_matrix(std::string_view text);
/// Does the first line that is no comment begin with a number?
bool begins_with_numbers(std::string_view text);

}  // namespace velum::app
