// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study_task.hpp"

#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "run/run.hpp"
#include "run/signals.hpp"
#include "study/submission.hpp"

namespace velum::app {
namespace {

struct Options {
  std::filesystem::path folder;
  std::size_t task = 0;
};

void study_task(const Options& options) {
  run::catch_signals();
  if (!study::run_task(options.folder, options.task, &run::stop_requested()))
    throw Exit{run::kInterrupted};
}

}  // namespace

void add_study_task(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("study-task", "Run the cells of one Slurm task of a study");
  command->group("");  // hidden
  command->add_option("FOLDER", options->folder, "DIR/slurm/<submission>")->required();
  command->add_option("--task", options->task, "number of the task; default: Slurm's")
      ->envname("SLURM_ARRAY_TASK_ID")
      ->type_name("N");
  command->callback([options] { study_task(*options); });
}

}  // namespace velum::app
