// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "plugins/registry.hpp"
#include "study/outcome.hpp"
#include "study/plan.hpp"

namespace velum::study {

/// What all cells of a study have in common.
struct Setup {
  std::filesystem::path graph;
  std::string text;  ///< of the graph's file when the study began
  std::vector<std::string> overrides;
  std::filesystem::path out;  ///< of the study; a cell's results lie in `cells/<variant>/<repeat>`
  std::filesystem::path cache;    ///< empty: none
  int threads = 1;                ///< of one cell
  std::set<std::string> sources;  ///< nodes of the graph that take from no other
  const std::atomic<bool>* cancel = nullptr;
};

/// Relative to the study's folder: "cells/v07/2".
[[nodiscard]] std::filesystem::path folder_of(const Plan& plan, const Cell& cell);

/// Runs one cell in this process. What goes wrong is its outcome; throws Cancelled when it was
/// interrupted.
[[nodiscard]] Outcome run_cell(const Plan& plan, const Cell& cell, const Setup& setup,
                               plugins::Registry& registry);

/// A full disk is no result of a cell: throws Error (Fault::output) when it is the reason.
void require_room(const Outcome& outcome, const std::filesystem::path& folder);

}  // namespace velum::study
