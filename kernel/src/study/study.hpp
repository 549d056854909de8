// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "graph/graph.hpp"
#include "graph/study_slurm.hpp"
#include "plugins/registry.hpp"
#include "study/comparison.hpp"

namespace velum::study {

struct StudyOptions {
  std::filesystem::path out;
  std::vector<std::string> overrides;  ///< as the graph was loaded with
  std::filesystem::path cache;         ///< empty: none
  int jobs = 0;                        ///< cells at a time; 0: a thread each, or one if exclusive
  int threads = 0;                     ///< of a cell; 0: what the jobs leave to each
  std::optional<double> seconds;       ///< of a cell, instead of the study's
  std::optional<std::uint64_t> bytes;
  bool resume = false;
  bool retry = false;  ///< with resume: cells that are not ok run again
  /// Slurm runs the cells, asked like this; else they run here.
  std::optional<graph::Slurm> slurm;
  /// Told what happens to Slurm's tasks, a line each.
  std::function<void(const std::string&)> note = [](const std::string&) {};
  const std::atomic<bool>* cancel = nullptr;
};

struct StudyResult {
  Plan plan;
  Comparison comparison;
  bool finished = false;  ///< false: interrupted, and there is no comparison
  std::size_t done = 0;   ///< cells of which the outcome is known
};

/// Told of each cell that ends: how many are done, and how many there are.
using CellEnded = std::function<void(const Plan&, const Cell&, const Outcome&, std::size_t done)>;

/// Runs the study of `graph` into its folder: a process a cell, here or in tasks of Slurm, the
/// journal as it goes, study.csv and study.json at its end. Cells whose outcome the journal has are
/// not run again. Throws Error when it cannot begin or write.
StudyResult run_study(const graph::Graph& graph, plugins::Registry& registry,
                      const StudyOptions& options, const CellEnded& ended);

}  // namespace velum::study
