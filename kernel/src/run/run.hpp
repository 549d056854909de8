// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "graph/graph.hpp"
#include "run/executor.hpp"

namespace velum::run {

struct RunResult {
  RunRecord record;
  std::filesystem::path record_file;  ///< in the output folder
  /// A stage did not return: leave by std::_Exit().
  bool abandoned = false;
};

/// What a run is asked for beyond its graph.
struct RunOptions {
  std::filesystem::path out;
  int threads = default_threads();
  std::uint64_t seed = 1;
  std::vector<std::string> only;
  std::filesystem::path cache;  ///< empty: none
  std::uint64_t cache_limit = Cache::kDefaultLimit;
  const std::atomic<bool>* cancel = nullptr;
  std::vector<Witness*> witnesses;
  /// Called when the record is written, while the output folder is still held.
  std::function<void(const RunResult&)> recorded;
  std::vector<std::string> others;  ///< what in `out` belongs to somebody else, and stays
};

/// Runs a graph into its output folder and writes the record there, also when a node fails or the
/// run is interrupted. `started` is told the record before the first node. Throws Error when the
/// run cannot begin, or its record not be written.
RunResult run_graph(const graph::Graph& graph, plugins::Registry& registry,
                    const RunOptions& options, Observer& observer,
                    const std::function<void(const RunRecord&)>& started = {});

/// 0, the status of the first failure, or kInterrupted.
int exit_status(const RunRecord& record);

/// How the graph is named in records: its path, absolute.
std::string graph_name(const std::filesystem::path& graph);

}  // namespace velum::run
