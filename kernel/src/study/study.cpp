// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/study.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "run/run.hpp"
#include "study/cell.hpp"
#include "study/folder.hpp"
#include "study/journal.hpp"
#include "study/pool.hpp"
#include "study/prepare.hpp"
#include "study/slurm.hpp"
#include "study/tables.hpp"
#include "velum/files.hpp"

namespace velum::study {
namespace {

namespace fs = std::filesystem;

/// Repeat by repeat, so that all variants are known a little before one is known well.
std::vector<Cell> cells_left(const Plan& plan, const Outcomes& known, bool retry) {
  std::vector<Cell> left;
  for (std::size_t r = 0; r < plan.study.seeds.size(); ++r)
    for (std::size_t v = 0; v < plan.variants.size(); ++v) {
      const auto found = known.find({v, r});
      if (found == known.end() || (retry && found->second.status != Status::ok))
        left.push_back({v, r});
    }
  return left;
}

using Done = std::function<void(const Cell&, const Outcome&)>;

/// A study that is under way, and the two ways to run its cells. Both return false when they were
/// interrupted.
class Run {
 public:
  Run(const graph::Graph& graph, plugins::Registry& registry, const Prepared& prepared,
      const StudyOptions& options, fs::path out)
      : registry_(registry),
        prepared_(prepared),
        options_(options),
        setup_{.graph = graph.path,
               .text = std::string(FileContent(graph.path).text()),
               .overrides = options.overrides,
               .out = std::move(out),
               .cache = options.cache.empty() ? fs::path() : fs::absolute(options.cache),
               .threads = 1,
               .sources = prepared.sources,
               .cancel = options.cancel} {}

  bool here(const std::vector<Cell>& cells, const Done& done) {
    const PoolOptions pool{jobs(), limit(options_.seconds, study().seconds),
                           limit(options_.bytes, study().bytes), options_.cancel};
    setup_.threads =
        options_.threads > 0 ? options_.threads : std::max(1, run::default_threads() / pool.jobs);
    return run_cells(
        cells, pool,
        [&](const Cell& cell) {
          return Process([&, cell] { return run_cell(prepared_.plan, cell, setup_, registry_); },
                         setup_.out / (folder_of(prepared_.plan, cell).string() + ".log"));
        },
        done);
  }

  bool by_slurm(const std::vector<Cell>& cells, const Done& done) {
    SlurmOptions slurm;
    slurm.wishes = *options_.slurm;
    if (options_.threads > 0) slurm.wishes.cpus = options_.threads;
    slurm.common = {.graph = setup_.graph,
                    .text = setup_.text,
                    .overrides = setup_.overrides,
                    .key = prepared_.heading.key,
                    .working_folder = fs::current_path(),
                    .out = setup_.out,
                    .cache = setup_.cache,
                    .threads = slurm.wishes.cpus,
                    .seconds = limit(options_.seconds, study().seconds),
                    .bytes = limit(options_.bytes, study().bytes),
                    .cells = {}};
    slurm.at_once = static_cast<std::size_t>(options_.jobs);
    slurm.exclusive = study().exclusive;
    slurm.cancel = options_.cancel;
    slurm.note = options_.note;
    return run_on_slurm(cells, slurm, done);
  }

 private:
  [[nodiscard]] const graph::Study& study() const { return prepared_.plan.study; }
  [[nodiscard]] int jobs() const {
    return study().exclusive ? 1 : options_.jobs > 0 ? options_.jobs : run::default_threads();
  }
  template <class T>
  static std::optional<T> limit(const std::optional<T>& wanted, const std::optional<T>& said) {
    return wanted ? wanted : said;
  }

  plugins::Registry& registry_;
  const Prepared& prepared_;
  const StudyOptions& options_;
  Setup setup_;
};

/// Tasks of an earlier study in the folder may still write there.
void refuse_running_tasks(const StudyOptions& options) {
  const bool taken_up = options.slurm && options.resume && !options.retry;
  std::error_code none;
  if (taken_up || !(options.slurm || fs::exists(options.out / kTasksName, none))) return;
  require_idle(options.out, options.slurm.has_value());
}

void write_results(const fs::path& folder, const StudyResult& result, const Outcomes& outcomes,
                   const std::string& graph) {
  write_file(folder / "study.csv", csv(result.plan, outcomes, result.comparison));
  write_file(folder / "study.json", json(result.plan, outcomes, result.comparison, graph));
}

}  // namespace

StudyResult run_study(const graph::Graph& graph, plugins::Registry& registry,
                      const StudyOptions& options, const CellEnded& ended) {
  if (graph.study) require_effect(*graph.study, options.overrides);
  const Prepared prepared = prepare(graph, registry);
  StudyResult result{prepared.plan, {}, false, 0};
  refuse_running_tasks(options);
  const Folder folder(options.out, prepared.heading, options.resume);
  Journal journal(folder.path() / kJournalName, prepared.heading);
  if (!options.slurm || options.retry)
    collect_tasks(folder.path(), prepared.heading.key,
                  [&](const Cell& cell, const Outcome& one) { journal.add(cell, one); });

  const std::vector<Cell> left = cells_left(prepared.plan, journal.outcomes(), options.retry);
  result.done = prepared.plan.cells() - left.size();
  const Done done = [&](const Cell& cell, const Outcome& outcome) {
    require_room(outcome, folder.path());
    journal.add(cell, outcome);
    // Slurm's tasks have what they did on the disk already.
    if (!options.slurm) journal.sync();
    ended(prepared.plan, cell, outcome, ++result.done);
  };
  Run run(graph, registry, prepared, options, folder.path());
  result.finished = options.slurm ? run.by_slurm(left, done) : run.here(left, done);
  journal.sync();
  if (!result.finished) return result;
  result.comparison = compare(prepared.plan, journal.outcomes());
  write_results(folder.path(), result, journal.outcomes(), prepared.heading.graph);
  return result;
}

}  // namespace velum::study
