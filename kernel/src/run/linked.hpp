// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace velum::run {

/// What a plugin that this process has opened links: file, size and time of each library that it
/// names, as text. Part of a result's key, so that another version of PCL makes another result.
std::string linked_libraries(const std::filesystem::path& plugin);

/// XXH3-128 of libvelum itself.
const std::string& kernel_hash();

}  // namespace velum::run
