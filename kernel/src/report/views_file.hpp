// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/view.hpp"

/// views.bin: what a report shows of a run's values, kept beside run.json (docs/record.md).
namespace velum::report {

struct ViewsFile {
  std::string record;  ///< XXH3-128 of the run.json that it belongs to
  std::vector<View> views;
};

/// Atomically. Throws Error (Fault::output).
void write_views(const std::filesystem::path& file, const ViewsFile& content);
/// Throws Error (Fault::input) when the file is damaged or of another version.
[[nodiscard]] ViewsFile read_views(const std::filesystem::path& file);

}  // namespace velum::report
