// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <vector>

#include "run/node_runner.hpp"

namespace velum::run {

enum class Ended {
  done,         ///< every node ended, well or not
  interrupted,  ///< every stage that ran has returned, the other nodes are skipped
  abandoned     ///< a stage did not return in time: the process has to end without it
};

/// How long a stage may take to return when the run is interrupted.
inline constexpr std::chrono::milliseconds kPatience{1500};

/// Runs the nodes of a graph: ready ones at once, under one budget of threads. When one fails, what
/// depends on it is skipped and the rest goes on.
class Executor {
 public:
  Executor(const graph::Graph& graph, plugins::Registry& registry, ExecuteOptions options,
           Observer& observer);
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  /// Once. After `abandoned` the executor must not be destroyed.
  Ended run();
  /// What is known of nodes, files, inputs and the first failure; the rest is not filled in.
  [[nodiscard]] RunRecord record() { return nodes_.record(); }

 private:
  using Clock = std::chrono::steady_clock;

  void work();
  void call_workers();
  std::vector<std::size_t> finish(std::size_t node, Status status);
  Ended watch(std::unique_lock<std::mutex>& lock);
  [[nodiscard]] bool cancelled() const;
  [[nodiscard]] bool is_over() const { return busy_ == 0 && (ready_.empty() || cancelled()); }

  const ExecuteOptions options_;
  NodeRunner nodes_;
  std::mutex mutex_;
  std::condition_variable work_;
  std::condition_variable watch_;
  std::set<std::size_t> ready_;       ///< the first of the graph's order go first
  std::vector<std::size_t> waiting_;  ///< sources not ended yet, by node
  std::vector<bool> dropped_;         ///< nodes that will not run
  std::size_t busy_ = 0;
  std::size_t idle_ = 0;
  bool over_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace velum::run
