// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "study/cell.hpp"
#include "study/slurm_queue.hpp"
#include "study/submission.hpp"

namespace velum::study {

/// How a study is run by Slurm.
struct SlurmOptions {
  graph::Slurm wishes;
  Submission common;        ///< what all tasks are told; without cells
  std::size_t at_once = 0;  ///< most tasks that run at a time; 0: Slurm decides
  bool exclusive = false;
  const std::atomic<bool>* cancel = nullptr;
  /// Told what happens to the tasks, a line each.
  std::function<void(const std::string&)> note;
};

/// Runs the cells as tasks of Slurm and follows them to their end. Tasks that an earlier call has
/// submitted for this folder and key are taken up. A cell whose task was lost is submitted again,
/// kMostTries times. Returns false when it was interrupted, or when tasks were cancelled: the tasks
/// that wait or run go on. Throws Error when Slurm refuses, or does not run anything.
bool run_on_slurm(const std::vector<Cell>& cells, const SlurmOptions& options,
                  const std::function<void(const Cell&, Outcome)>& done);
inline constexpr int kMostTries = 3;

/// Tells what tasks of an earlier call have left in the study's folder, and removes all of them:
/// one that may still come finds nothing to do.
void collect_tasks(const std::filesystem::path& study, const std::string& key,
                   const std::function<void(const Cell&, Outcome)>& done);

/// Throws Error (Fault::output) when tasks of the study in this folder wait or run, and, if Slurm
/// is needed, when it does not answer.
void require_idle(const std::filesystem::path& study, bool needed);

}  // namespace velum::study
