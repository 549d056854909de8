// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "study/comparison.hpp"

/// A study's results as files and on the terminal (docs/studies.md).
namespace velum::study {

/// study.csv: a row a cell.
[[nodiscard]] std::string csv(const Plan& plan, const Outcomes& outcomes,
                              const Comparison& comparison);
/// study.json: all of it, a variant a line.
[[nodiscard]] std::string json(const Plan& plan, const Outcomes& outcomes,
                               const Comparison& comparison, const std::string& graph);
/// For people: a row a variant, mean and standard deviation of each measure, the best first. Of
/// many variants only the first ones.
[[nodiscard]] std::string text(const Plan& plan, const Comparison& comparison);

}  // namespace velum::study
