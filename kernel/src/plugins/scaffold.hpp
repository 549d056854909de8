// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace velum::plugins {

/// The files that a new plugin begins with, by name.
const std::map<std::string, std::string>& templates();

/// What `velum new` made.
struct Scaffold {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> files;
  bool in_checkout = false;  ///< a folder of Velum's own sources; else a project of its own
};

/// Writes the folder of a new plugin that builds and passes its test: plugins/<kind>/<name>/ when
/// `where` lies in a checkout of Velum (and the line that builds it), else `where`/<name>/ with a
/// CMakeLists.txt of its own. Throws Error: Fault::graph for a name that cannot be or a folder that
/// is there already, Fault::output when it cannot be written.
Scaffold new_plugin(const std::string& id, const std::filesystem::path& where);

}  // namespace velum::plugins
