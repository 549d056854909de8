// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "graph/study_slurm.hpp"

namespace velum::study {

/// What Slurm knows of one task of a job array.
struct QueuedTask {
  std::string job;
  std::size_t index = 0;
  std::string state;  ///< Slurm's word: "RUNNING", "NODE_FAIL"
  std::string nodes;
  std::string reason;            ///< why it waits or has failed, in Slurm's words
  std::filesystem::path folder;  ///< in which it runs: that of its submission

  /// Will it, as far as Slurm knows, do no more?
  [[nodiscard]] bool ended() const;
};

/// An array of tasks to submit.
struct TaskArray {
  std::filesystem::path folder;
  std::filesystem::path script;
  std::size_t tasks = 1;
  std::size_t at_once = 0;  ///< most tasks that run at a time; 0: Slurm decides
  bool exclusive = false;   ///< nothing else on its node while a task runs
};

/// Slurm's queue, by its commands sbatch and squeue; all tasks of one study have one name.
class SlurmQueue {
 public:
  explicit SlurmQueue(std::string name) : name_(std::move(name)) {}

  [[nodiscard]] const std::string& name() const { return name_; }
  /// The number of the job. Throws Error (Fault::graph) with what Slurm says when it refuses.
  [[nodiscard]] std::string submit(const TaskArray& array, const graph::Slurm& wishes) const;
  /// The study's tasks that wait, run, or have ended a while ago (Slurm's MinJobAge); nothing when
  /// Slurm does not answer. Throws Error (Fault::graph) when there is no Slurm.
  [[nodiscard]] std::optional<std::vector<QueuedTask>> tasks() const;

 private:
  std::string name_;
};

/// What a study's tasks are called, by its folder.
[[nodiscard]] std::string slurm_name(const std::filesystem::path& study);

}  // namespace velum::study
