// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "run/run.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "console.hpp"
#include "graph/graph.hpp"
#include "report/pictures.hpp"
#include "report/run_report.hpp"
#include "report/watch.hpp"
#include "reporters.hpp"
#include "run/output_folder.hpp"
#include "run/signals.hpp"
#include "study/folder.hpp"

namespace velum::app {
namespace {

constexpr const char* kExamples = R"(Examples:
  velum run sails.toml
  velum run sails.toml --set smooth.radius="60 mm" --out smoother
  velum run sails.toml --only mesh             only that node and what it needs
  velum run sails.toml --json | jq .event      one JSON object a line

A second run takes from the cache what has not changed. Ctrl-C stops cleanly; what is done is kept.)";

struct Options {
  std::filesystem::path graph;
  std::filesystem::path out;
  std::vector<std::string> overrides;
  std::vector<std::string> only;
  int threads = run::default_threads();
  std::uint64_t seed = 1;
  std::filesystem::path cache;
  std::uint64_t cache_size = run::Cache::kDefaultLimit;
  bool no_cache = false;
  bool report = false;
  std::filesystem::path png;
  std::string png_colour;
  bool json = false;
};

run::RunOptions run_options(const Options& options) {
  run::RunOptions result;
  result.out = options.out;
  result.threads = options.threads;
  result.seed = options.seed;
  result.only = options.only;
  if (!options.no_cache)
    result.cache = options.cache.empty() ? run::default_cache_folder() : options.cache;
  result.cache_limit = options.cache_size;
  result.cancel = &run::stop_requested();
  result.others = study::names_of_study(options.out, run::graph_name(options.graph));
  return result;
}

/// What a run leaves besides its record, for people to look at.
class Extras {
 public:
  /// Throws Error (Fault::output) when it cannot be made, before anything runs.
  Extras(const graph::Graph& graph, plugins::Registry& registry, const Options& options)
      : registry_(registry) {
    if (options.report) {
      page_.emplace();
      watch_ = std::make_unique<report::ViewWatch>(graph, report::kRunLimit, options.threads);
    }
    if (options.png.empty()) return;
    refuse_within(options.png, options.out);
    pictures_ = std::make_unique<report::PictureWatch>(options.png, options.png_colour);
  }

  void ask(run::RunOptions& options) {
    if (pictures_) options.witnesses.push_back(pictures_.get());
    if (!watch_) return;
    options.witnesses.push_back(watch_.get());
    options.recorded = [this](const run::RunResult& result) {
      leave(result.record_file.parent_path());
    };
  }

  /// 6 where report or pictures could not be written.
  int tell(Reporter& reporter, const std::filesystem::path& out) const {
    int status = 0;
    if (pictures_)
      if (const auto failed = pictures_->failed()) status = tell(*failed);
    if (!watch_) return status;
    for (const std::string& trouble : watch_->troubles())
      complain("warning: report: " + trouble + "\n");
    if (failed_) return tell(*failed_);
    reporter.report_written(out / run::kReportName);
    return status;
  }

 private:
  static int tell(const Error& error) {
    complain(format(error));
    return static_cast<int>(Fault::output);
  }

  // The next run would take the pictures for somebody's files.
  static void refuse_within(const std::filesystem::path& folder, const std::filesystem::path& out) {
    namespace fs = std::filesystem;
    const fs::path outer = fs::weakly_canonical(fs::absolute(out));
    const fs::path inner = fs::weakly_canonical(fs::absolute(folder));
    if (std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end())
      throw Error(Fault::graph, "the pictures would lie in the output folder")
          .at(inner.string())
          .hint("choose another folder with --png or --out");
  }

  // The run itself went as its record says.
  void leave(const std::filesystem::path& folder) {
    try {
      report::leave_run_report(folder, *page_, watch_->views(), registry_);
    } catch (const Error& error) {
      failed_ = error;
    } catch (const std::exception& error) {
      failed_ = Error(Fault::output, std::string("the report could not be made: ") + error.what());
    }
  }

  plugins::Registry& registry_;
  std::optional<report::Page> page_;
  std::unique_ptr<report::ViewWatch> watch_;
  std::unique_ptr<report::PictureWatch> pictures_;
  std::optional<Error> failed_;
};

int run_checked(const graph::Graph& graph, plugins::Registry& registry, const Options& options,
                Reporter& reporter) {
  Extras extras(graph, registry, options);
  run::catch_signals();
  run::RunOptions asked = run_options(options);
  extras.ask(asked);
  const run::RunResult result = run::run_graph(
      graph, registry, asked, reporter,
      [&](const run::RunRecord& record) { reporter.run_started(record, options.out); });
  const int report_status = extras.tell(reporter, options.out);
  reporter.run_ended(result);
  if (result.abandoned) std::_Exit(run::kInterrupted);
  const int status = run::exit_status(result.record);
  return status != 0 ? status : report_status;
}

void run_command(Options options) {
  if (options.out.empty()) options.out = options.graph.stem().string() + ".out";
  const auto reporter =
      options.json ? make_json_reporter() : make_text_reporter(on_terminal(), !options.no_cache);
  plugins::Registry registry;
  const graph::Loaded loaded = graph::load(options.graph, options.overrides, registry,
                                           graph::LoadOptions{.out = options.out});
  if (!loaded.graph) {
    reporter->refused(loaded.diagnostics);
    throw Exit{graph::exit_status(loaded.diagnostics)};
  }
  int status = 0;
  try {
    status = run_checked(*loaded.graph, registry, options, *reporter);
  } catch (const Error& error) {
    reporter->refused(error);
    status = static_cast<int>(error.fault());
  }
  if (status != 0) throw Exit{status};
}

}  // namespace

void add_run(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("run", "Run a graph");
  command->footer(kExamples);
  command->add_option("GRAPH", options->graph, "the graph, a TOML file")->required();
  command->add_option("--out", options->out, "output folder; default: <graph>.out here")
      ->type_name("DIR");
  command->add_option("--set", options->overrides, "node.param=VALUE: another value for this run")
      ->type_name("TEXT")
      ->allow_extra_args(false);
  command->add_option("--only", options->only, "run this node and what it needs")
      ->type_name("NODE")
      ->allow_extra_args(false);
  command->add_option("--threads", options->threads, "threads; default: all processors")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  const auto no_sign = [](const std::string& text) {
    return text.starts_with("-") ? "it cannot be negative" : "";
  };
  const auto is_seed = [](const std::string& text) -> std::string {
    std::int64_t seed = 0;  // as in a graph
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), seed);
    const bool whole = failed == std::errc() && end == text.data() + text.size() && seed >= 0;
    return whole ? "" : "'" + text + "' is no whole number from 0 to 9223372036854775807";
  };
  command->add_option("--seed", options->seed, "seed of all random numbers; default: 1")
      ->type_name("N")
      ->check(CLI::Validator(is_seed, ""));
  auto* cache =
      command->add_option("--cache", options->cache, "where results are kept")->type_name("DIR");
  command->add_option("--cache-size", options->cache_size, "its largest size, as 500MB or 4GB")
      ->type_name("SIZE")
      ->transform(CLI::AsSizeValue(true))
      ->check(CLI::Validator(no_sign, ""));
  command->add_flag("--no-cache", options->no_cache, "run everything; keep nothing")
      ->excludes(cache);
  command->add_flag("--report", options->report, "also write report.html");
  command->add_option("--png", options->png, "also draw each cloud and mesh into this folder")
      ->type_name("DIR");
  command
      ->add_option("--png-colour", options->png_colour, "by this column; default: what tells most")
      ->type_name("COLUMN");
  command->add_flag("--json", options->json, "one JSON event a line on standard output");
  command->callback([options] { run_command(*options); });
}

}  // namespace velum::app
