// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "study/plan.hpp"
#include "study/process.hpp"

namespace velum::study {

struct PoolOptions {
  int jobs = 1;                   ///< cells at a time
  std::optional<double> seconds;  ///< of one cell
  std::optional<std::uint64_t> bytes;
  const std::atomic<bool>* cancel = nullptr;
};

/// Runs the cells in order, several at a time, each in a process of its own within its limits.
/// `start` makes the process, `done` is told each outcome, in the order in which cells end. Returns
/// false when it was interrupted: what then runs is asked to stop, and dropped.
bool run_cells(const std::vector<Cell>& cells, const PoolOptions& options,
               const std::function<Process(const Cell&)>& start,
               const std::function<void(const Cell&, Outcome)>& done);

}  // namespace velum::study
