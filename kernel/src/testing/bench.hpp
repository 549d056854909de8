// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "plugins/registry.hpp"

namespace velum::test {

/// The plugins of this test program.
plugins::Registry& registry();

/// A folder for files that stages write in tests; it goes with the process.
std::filesystem::path scratch_folder();

/// The settings of a run in the order of `info`: those given, else the defaults. Output files that
/// are not absolute come to lie in `folder`. Throws Error (Fault::graph) when a required one is
/// missing.
std::vector<Setting> settings_of(const StageInfo& info, const std::map<std::string, Setting>& given,
                                 const std::filesystem::path& folder);

}  // namespace velum::test
