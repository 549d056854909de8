// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT

#include <cstdlib>
#include <filesystem>
#include <memory>

#include "again.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "reporters.hpp"
#include "run/compare.hpp"
#include "run/record_file.hpp"
#include "run/signals.hpp"

namespace velum::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  fs::path record;
  fs::path out;
  int threads = 0;
};

int rerun(const run::Json& record, const Options& options, const fs::path& out) {
  plugins::Registry registry;
  const graph::Loaded loaded = graph_of(record, out, registry);
  if (!loaded.graph) {
    complain(graph::format(loaded.diagnostics));
    return graph::exit_status(loaded.diagnostics);
  }
  const run::RunOptions asked = options_of(record, options.threads, out, options.record.string());
  run::catch_signals();
  const auto reporter = make_text_reporter(on_terminal(), false);
  const run::RunResult result =
      run::run_graph(*loaded.graph, registry, asked, *reporter,
                     [&](const run::RunRecord& begun) { reporter->run_started(begun, out); });
  if (result.abandoned) {
    // Stages that do not listen still run; nothing is unwound.
    std::error_code ignored;
    if (options.out.empty()) fs::remove_all(out, ignored);
    std::_Exit(run::kInterrupted);
  }
  if (result.record.status == run::Status::interrupted) return run::kInterrupted;
  const auto differences = run::compare(record, run::to_json(result.record));
  for (const std::string& difference : differences) print("differs: " + difference + "\n");
  if (differences.empty()) print("the same: every hash agrees\n");
  return differences.empty() ? 0 : static_cast<int>(Fault::stage);
}

void rerun_command(const Options& options) {
  if (!fs::exists(options.record))
    throw Error(Fault::graph, "there is no such file").at(options.record.string());
  const run::Json record =
      run::read_record(options.record, {"graph.resolved", "graph.path", "threads", "seed", "nodes",
                                        "inputs", "files", "machine.instruction_set"});
  int status = 0;
  try {
    if (options.out.empty()) {
      const TemporaryFolder folder;
      status = rerun(record, options, folder.path());
    } else {
      status = rerun(record, options, options.out);
    }
  } catch (const run::Json::exception&) {
    throw run::damaged_record(options.record);
  }
  if (status != 0) throw Exit{status};
}

}  // namespace

void add_rerun(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("rerun", "Run again what a record tells, without the cache, and compare");
  command->footer("Exit status: 0 where every hash is the same, 1 where something differs.");
  command->add_option("RUN.json", options->record, "the record of the earlier run")->required();
  command->add_option("--out", options->out, "keep the new results here")->type_name("DIR");
  command->add_option("--threads", options->threads, "threads; default: as before")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  command->callback([options] { rerun_command(*options); });
}

}  // namespace velum::app
