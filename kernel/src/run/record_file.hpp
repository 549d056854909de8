// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "run/json.hpp"
#include "velum/error.hpp"

namespace velum::run {

/// The record in `file`; throws Error (Fault::input) saying what was found when it is no JSON, no
/// object, or lacks one of `keys` ("graph", "graph.path").
[[nodiscard]] Json read_record(const std::filesystem::path& file,
                               const std::vector<std::string>& keys);
/// For a record whose keys are there, but hold something else than a run writes.
[[nodiscard]] Error damaged_record(const std::filesystem::path& file);

}  // namespace velum::run
