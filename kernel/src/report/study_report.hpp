// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "plugins/registry.hpp"
#include "report/page.hpp"

namespace velum::report {

/// Writes DIR/report.html from study.json, study.csv, and the views of those cells that have left
/// them: of each variant, the first repeat that is ok. Throws Error.
void write_study_report(const std::filesystem::path& folder, const Page& page,
                        plugins::Registry& registry);

/// Variants whose surfaces are shown; the first ones of a larger study.
inline constexpr std::size_t kMostVariants = 48;

inline constexpr const char* kStudyName = "study.json";
inline constexpr const char* kStudyTableName = "study.csv";

}  // namespace velum::report
