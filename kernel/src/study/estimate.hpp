// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "study/plan.hpp"

namespace velum::study {

/// "6 variants x 6 repeats = 36 cells, about 2 min", and what that is taken from: the cells of an
/// earlier study of this graph in `folder`, else a run of it there. When there is neither, that the
/// time is not known. `jobs`: cells at a time; 0: as many as there are processors.
[[nodiscard]] std::string outlook(const Plan& plan, const std::filesystem::path& folder,
                                  const std::string& graph, int jobs);

/// "40 s", "3 min", "2.5 h".
[[nodiscard]] std::string rough_time(double seconds);

}  // namespace velum::study
