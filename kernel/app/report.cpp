// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "again.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "report/run_report.hpp"
#include "report/study_report.hpp"
#include "report/views_file.hpp"
#include "report/watch.hpp"
#include "run/compare.hpp"
#include "run/output_folder.hpp"
#include "run/record_file.hpp"
#include "run/signals.hpp"
#include "velum/files.hpp"

namespace velum::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExamples = R"(Examples:
  velum report wind_tunnel.out       report.html of a run, from its record
  velum report meshing.out           that of a study

A run that was made without --report is run again, as far as the cache does not have its results.)";

struct Options {
  fs::path folder;
  fs::path cache;
};

/// Differences that are told; the rest is counted.
constexpr std::size_t kMostDifferences = 5;

/// The views that the run has left, if they belong to this record.
std::optional<report::Views> views_kept(const fs::path& folder) {
  const fs::path file = folder / run::kViewsName;
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) return std::nullopt;
  report::ViewsFile content = report::read_views(file);
  if (content.record != hash_of(FileContent(folder / run::kRecordName).bytes()))
    return std::nullopt;
  report::Views views(report::kRunLimit);
  for (report::View& view : content.views) views.add(std::move(view));
  return views;
}

[[noreturn]] void refuse(const std::vector<std::string>& differences, const fs::path& folder) {
  std::string text = "the run does not give the same again, so that its values cannot be shown:";
  for (std::size_t i = 0; i < std::min(differences.size(), kMostDifferences); ++i)
    text += "\n  " + differences[i];
  if (differences.size() > kMostDifferences)
    text += fmt::format("\n  and {} more", differences.size() - kMostDifferences);
  throw Error(Fault::stage, text)
      .at((folder / run::kRecordName).string())
      .hint("run the graph again with --report");
}

/// A report is no reason to start a scanner.
void refuse_devices(const graph::Graph& graph, const fs::path& folder) {
  for (const graph::Node& node : graph.nodes)
    if (node.info->determinism == Determinism::none)
      throw Error(
          Fault::graph,
          fmt::format("node '{}' ({}) does not give the same twice, so that the run's values "
                      "cannot be had again",
                      node.name, node.use))
          .at((folder / run::kRecordName).string())
          .hint("run the graph with --report, which leaves views.bin for this");
}

class Silent final : public run::Observer {};

/// The values of the record's run, from the cache or made again.
report::Views views_again(const run::Json& record, const Options& options,
                          plugins::Registry& registry) {
  const TemporaryFolder out;
  const graph::Loaded loaded = graph_of(record, out.path(), registry);
  if (!loaded.graph) {
    complain(graph::format(loaded.diagnostics));
    throw Exit{graph::exit_status(loaded.diagnostics)};
  }
  refuse_devices(*loaded.graph, options.folder);
  run::RunOptions asked =
      options_of(record, 0, out.path(), (options.folder / run::kRecordName).string());
  asked.cache = options.cache.empty() ? run::default_cache_folder() : options.cache;
  report::ViewWatch watch(*loaded.graph, report::kRunLimit, asked.threads);
  asked.witnesses.push_back(&watch);
  run::catch_signals();
  Silent nobody;
  const run::RunResult result = run::run_graph(*loaded.graph, registry, asked, nobody);
  if (result.abandoned) {
    // Stages that do not listen still run; nothing is unwound.
    std::error_code ignored;
    fs::remove_all(out.path(), ignored);
    std::_Exit(run::kInterrupted);
  }
  if (result.record.status == run::Status::interrupted) throw Exit{run::kInterrupted};
  const auto differences = run::compare(record, run::to_json(result.record));
  if (!differences.empty()) refuse(differences, options.folder);
  for (const std::string& trouble : watch.troubles()) complain("warning: " + trouble + "\n");
  return watch.views();
}

void run_report(const Options& options, const report::Page& page, plugins::Registry& registry) {
  const run::Json record = report::read_record(options.folder / run::kRecordName);
  if (const auto kept = views_kept(options.folder)) {
    report::write_run_report(options.folder, page, *kept, registry);
    return;
  }
  try {
    report::leave_run_report(options.folder, page, views_again(record, options, registry),
                             registry);
  } catch (const run::Json::exception&) {
    throw run::damaged_record(options.folder / run::kRecordName);
  }
}

void report_command(const Options& options) {
  const report::Page page;
  plugins::Registry registry;
  const fs::path run = options.folder / run::kRecordName;
  const fs::path study = options.folder / report::kStudyName;
  // A run and a study of one graph may share a folder: the report is that of the later one.
  if (fs::exists(run) &&
      (!fs::exists(study) || fs::last_write_time(run) > fs::last_write_time(study))) {
    run_report(options, page, registry);
  } else if (fs::exists(study)) {
    report::write_study_report(options.folder, page, registry);
  } else {
    throw Error(Fault::graph, "the folder has neither run.json nor study.json")
        .at(options.folder.string())
        .hint("give the output folder of `velum run` or `velum study`");
  }
  print((options.folder / run::kReportName).string() + "\n");
}

}  // namespace

void add_report(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("report", "Make report.html again from what a run or study has left");
  command->footer(kExamples);
  command->add_option("DIR", options->folder, "output folder of a run or study")->required();
  command->add_option("--cache", options->cache, "where results are kept")->type_name("DIR");
  command->callback([options] { report_command(*options); });
}

}  // namespace velum::app
