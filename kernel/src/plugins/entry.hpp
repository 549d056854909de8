// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

#include "velum/abi.hpp"

namespace velum::plugins {

/// Reads a plugin's entry from its file without opening it, and checks that it holds the stage `id`
/// and was built for this Velum. Throws Error (Fault::plugin) that names what differs.
void check_entry(const std::filesystem::path& file, std::string_view id);

/// Throws Error (Fault::plugin) naming the first field in which `plugin` differs from this Velum.
void check_fingerprint(const Fingerprint& plugin, const std::filesystem::path& file);

}  // namespace velum::plugins
