// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "run/run.hpp"
#include "study/cell.hpp"
#include "study/journal.hpp"
#include "study/pool.hpp"
#include "study/prepare.hpp"
#include "study/submission.hpp"
#include "velum/error.hpp"

namespace velum::study {
namespace {

namespace fs = std::filesystem;

Submission submission_in(const fs::path& folder, std::size_t task) {
  auto submission = read_submission(folder);
  if (!submission)
    throw Error(Fault::input, "no submission of a study is there").at(folder.string());
  if (task >= submission->tasks())
    throw Error(Fault::graph, fmt::format("there is no task {}, the last one is {}", task,
                                          submission->tasks() - 1))
        .at(folder.string());
  return std::move(*submission);
}

graph::Graph graph_of(const Submission& submission, plugins::Registry& registry) {
  graph::Loaded loaded =
      graph::load_text(submission.text, submission.graph, submission.overrides, registry);
  if (!loaded.graph) throw Error(Fault::graph, graph::format(loaded.diagnostics));
  return std::move(*loaded.graph);
}

}  // namespace

bool run_task(const fs::path& folder, std::size_t task, const std::atomic<bool>* cancel) {
  const Submission submission = submission_in(folder, task);
  if (is_given_up(folder, task)) return false;
  fs::current_path(submission.working_folder);
  plugins::Registry registry;
  const Prepared prepared = prepare(graph_of(submission, registry), registry, false);
  if (!submission.key.starts_with(prepared.heading.key))
    throw Error(Fault::graph,
                "this host does not see the study that was submitted: its plugins, "
                "its version of Velum or the graph are others")
        .at(folder.string())
        .hint("share them among all hosts, unchanged while the study runs");
  const Setup setup{.graph = submission.graph,
                    .text = submission.text,
                    .overrides = submission.overrides,
                    .out = submission.out,
                    .cache = submission.cache,
                    .threads = submission.threads,
                    .sources = prepared.sources,
                    .cancel = cancel};
  const PoolOptions pool{1, submission.seconds, submission.bytes, cancel};
  const auto start = [&](const Cell& cell) {
    return Process([&, cell] { return run_cell(prepared.plan, cell, setup, registry); },
                   setup.out / (folder_of(prepared.plan, cell).string() + ".log"));
  };
  // Slurm may have started this task before: what it has done then is done.
  Journal journal(journal_of(folder, task), {prepared.heading.graph, submission.key});
  for (const Cell& cell : submission.cells_of(task)) {
    if (journal.outcomes().contains({cell.variant, cell.repeat})) continue;
    if (is_given_up(folder, task)) return false;
    const bool ended = run_cells({cell}, pool, start, [&](const Cell& one, const Outcome& outcome) {
      require_room(outcome, setup.out);
      journal.add(one, outcome);
      journal.sync();
    });
    if (!ended) return false;
  }
  return true;
}

}  // namespace velum::study
