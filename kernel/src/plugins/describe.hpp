// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "velum/about.hpp"

namespace velum::plugins {

/// All that is said of a stage, for people. `example` is the text of a graph; it may be empty.
std::string describe_text(const StageInfo& info, const std::string& example);

/// The same for programs; numbers are in the unit that stands beside them, SI throughout.
nlohmann::ordered_json describe_json(const StageInfo& info, const std::string& example);

/// The example graph that lies beside a plugin's file; empty when there is none.
std::string example_beside(const std::filesystem::path& plugin);

}  // namespace velum::plugins
