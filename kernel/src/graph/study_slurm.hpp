// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "graph/diagnostic.hpp"
#include "graph/toml.hpp"

namespace velum::graph {

/// What a study's tasks ask of Slurm, [study.slurm]; what is not said is left to the cluster. It is
/// no part of the graph: where a study runs decides nothing of what it gives.
struct Slurm {
  std::string account;
  std::string partition;
  std::optional<double> seconds;  ///< of a task
  std::optional<std::uint64_t> bytes;
  int cpus = 1;                       ///< of a task: the threads of a cell
  std::optional<std::int64_t> cells;  ///< that a task runs, one after another
  std::size_t array = 1000;           ///< most tasks of a job
  std::vector<std::string> options;   ///< further ones of sbatch
};

/// Reads one key of [study.slurm]; what is wrong is reported.
void read_slurm(const toml::Entry& entry, const Reporter& report, Slurm& slurm);

/// The same of "key=VALUE" on the command line, the value as TOML or bare text. Throws Error
/// (Fault::graph).
void set_slurm(const std::string& text, Slurm& slurm);

/// What the [study.slurm] of a graph's text says; the text has no mistakes.
[[nodiscard]] Slurm slurm_in(const std::string& graph);

}  // namespace velum::graph
