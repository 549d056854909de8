// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace velum::plugins {

/// Lower-case letters, digits and underscores, a letter first: kinds, stages, ports, parameters.
bool is_name(std::string_view text);
/// "kind.name".
bool is_id(std::string_view text);

/// Where plugins are looked for, in this order: the folders of VELUM_PLUGIN_PATH (colon-separated),
/// then the one that belongs to this libvelum. Never the working directory.
std::vector<std::filesystem::path> search_path();
/// The folder that holds libvelum.so.
std::filesystem::path library_folder();

/// The plugin files of one stage, the one that counts first, then those that it hides.
using Files = std::vector<std::filesystem::path>;
/// All plugins below `path` by their id, from the names of their files alone.
std::map<std::string, Files, std::less<>> find_plugins(
    const std::vector<std::filesystem::path>& path);
/// The plugin files of one stage; only its own places are looked at.
Files find_plugin(const std::vector<std::filesystem::path>& path, std::string_view id);

}  // namespace velum::plugins
