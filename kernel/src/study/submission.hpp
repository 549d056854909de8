// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "study/outcome.hpp"
#include "study/plan.hpp"

namespace velum::study {

/// What the tasks of one job array are to do: the file submission.json in a folder of its own,
/// `DIR/slurm/<name>`. Beside it each task has its journal, `<task>.journal`, which it alone
/// writes, and what it printed, `<task>.log`.
struct Submission {
  std::filesystem::path graph;
  std::string text;  ///< of the graph when the study began
  std::vector<std::string> overrides;
  std::string key;  ///< of the study; a task whose own is another one does nothing
  std::filesystem::path working_folder;  ///< where the study was begun: `graph` may be relative
  std::filesystem::path out;             ///< of the study
  std::filesystem::path cache;           ///< empty: none
  int threads = 1;
  std::optional<double> seconds;  ///< of a cell
  std::optional<std::uint64_t> bytes;
  std::size_t cells_a_task = 1;
  std::vector<Cell> cells;  ///< in order; the first ones are those of task 0

  [[nodiscard]] std::size_t tasks() const {
    return (cells.size() + cells_a_task - 1) / cells_a_task;
  }
  [[nodiscard]] std::span<const Cell> cells_of(std::size_t task) const;
};

/// Throws Error (Fault::output).
void write_submission(const std::filesystem::path& folder, const Submission& submission);
/// Nothing when there is none, or not a whole one.
[[nodiscard]] std::optional<Submission> read_submission(const std::filesystem::path& folder);

[[nodiscard]] std::filesystem::path journal_of(const std::filesystem::path& folder,
                                               std::size_t task);

/// A task that has been given up begins no further cell, whatever became of it: another one has its
/// cells. Throws Error (Fault::output).
void give_up(const std::filesystem::path& folder, std::size_t task);
[[nodiscard]] bool is_given_up(const std::filesystem::path& folder, std::size_t task);

/// The script that Slurm runs for each task: `velum study-task FOLDER`.
[[nodiscard]] std::filesystem::path write_task_script(const std::filesystem::path& folder);

/// Runs the cells of a task that its journal does not have yet, one after another. Returns false
/// when it was interrupted or given up. Throws Error when it cannot begin or write.
bool run_task(const std::filesystem::path& folder, std::size_t task,
              const std::atomic<bool>* cancel);

}  // namespace velum::study
