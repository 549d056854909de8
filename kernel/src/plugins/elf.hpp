// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

namespace velum::plugins {

/// The first `limit` bytes of the section `name` of a 64-bit ELF shared object, read without
/// opening it. Throws Error (Fault::plugin) when the file is not one, is cut short (opening it
/// would end the process with SIGBUS) or has no such section.
std::vector<std::byte> read_section(const std::filesystem::path& file, std::string_view name,
                                    std::size_t limit);

}  // namespace velum::plugins
