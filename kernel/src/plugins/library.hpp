// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "velum/stage.hpp"

namespace velum::plugins {

/// Opens a plugin for the rest of the process's life and returns its stage. A static constructor
/// that crashes takes the process with it: probe() the file first. Throws Error (Fault::plugin).
const StageType& open_stage(const std::filesystem::path& file);

/// What is wrong in a stage's description, one line each: ports without a name, parameters named
/// twice, defaults outside their range and the like.
std::vector<std::string> faults_of(const StageInfo& info);

}  // namespace velum::plugins
