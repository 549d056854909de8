// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/study.hpp"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "console.hpp"
#include "graph/settings.hpp"
#include "graph/study_slurm.hpp"
#include "graph/units.hpp"
#include "report/study_report.hpp"
#include "run/cache.hpp"
#include "run/output_folder.hpp"
#include "run/run.hpp"
#include "run/signals.hpp"
#include "study/estimate.hpp"
#include "study/slurm_queue.hpp"
#include "study/tables.hpp"
#include "velum/files.hpp"

namespace velum::app {
namespace {

constexpr const char* kExamples = R"(Examples:
  velum study radii.toml                      every variant of its [study]
  velum study radii.toml --resume             go on after a kill or Ctrl-C
  velum study radii.toml --engine slurm --slurm partition=short
  velum study radii.toml --jobs 1 --timeout "2 min" --memory "4 GB"

Exit status: 0, or 3 when the study is complete but some variants failed.)";

/// Some variants failed.
constexpr int kSomeFailed = 3;
/// Variants whose failure is told at the end; all of them are in the files.
constexpr std::size_t kMostReasons = 20;

struct Options {
  std::filesystem::path graph;
  study::StudyOptions study;
  bool no_cache = false;
  std::string timeout;
  std::string memory;
  std::string engine = "local";
  std::vector<std::string> slurm;  ///< KEY=VALUE
};

double seconds_of(const std::string& text) {
  Parameter parameter;
  parameter.name = "--timeout";
  parameter.type = ParameterType::duration;
  parameter.range = above(0.0);
  return std::get<double>(graph::parse_setting_text(parameter, text).value);
}

std::uint64_t bytes_of(const std::string& text) {
  if (const auto bytes = graph::parse_memory(text)) return *bytes;
  throw Error(Fault::graph, fmt::format("--memory '{}' is no amount of memory", text))
      .hint("write --memory \"2 GB\"");
}

graph::Slurm slurm_of(const Options& options) {
  graph::Slurm slurm = graph::slurm_in(std::string(FileContent(options.graph).text()));
  for (const std::string& setting : options.slurm) graph::set_slurm(setting, slurm);
  return slurm;
}

/// One line for each cell that ends.
class Progress {
 public:
  void operator()(const study::Plan& plan, const study::Cell& cell, const study::Outcome& outcome,
                  std::size_t done) {
    const study::Variant& variant = plan.variants[cell.variant];
    std::string line = fmt::format("[{}/{}] {}", done, plan.cells(), variant.id);
    for (std::size_t a = 0; a < plan.study.axes.size(); ++a)
      line += fmt::format(" {}={}", plan.study.axes[a].name, plan.label(variant, a));
    if (plan.study.seeds.size() > 1) line += fmt::format(" repeat {}", cell.repeat + 1);
    line += fmt::format(": {}", name_of(outcome.status));
    if (!outcome.message.empty()) line += " (" + outcome.message + ")";
    ++ended_;
    const double each =
        std::chrono::duration<double>(Clock::now() - began_).count() / static_cast<double>(ended_);
    const double left = each * static_cast<double>(plan.cells() - done);
    if (left > 5.0) line += ", about " + study::rough_time(left) + " left";
    complain(line + "\n");
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point began_ = Clock::now();
  std::size_t ended_ = 0;
};

/// 6 where report.html could not be written; 0 where only the page for it is not installed.
int leave_report(const std::filesystem::path& out, plugins::Registry& registry) {
  std::optional<report::Page> page;
  try {
    page.emplace();
  } catch (const Error& error) {
    complain("warning: no report.html: " + plugins::one_line(error) + "\n");
    return 0;
  }
  try {
    report::write_study_report(out, *page, registry);
  } catch (const Error& error) {
    complain(format(error));
    return static_cast<int>(Fault::output);
  }
  print((out / run::kReportName).string() + "\n");
  return 0;
}

int report_interrupted(const study::StudyResult& result, const study::StudyOptions& options) {
  complain(fmt::format("interrupted: {} of {} cells are kept in {}; --resume goes on\n",
                       result.done, result.plan.cells(), options.out.string()));
  if (options.slurm)
    complain(
        fmt::format("Slurm's tasks that wait or run go on: --engine slurm --resume takes them "
                    "up, `scancel --name={}` cancels them\n",
                    study::slurm_name(options.out)));
  return run::kInterrupted;
}

int report(const study::StudyResult& result, const study::StudyOptions& options) {
  const std::filesystem::path& out = options.out;
  if (!result.finished) return report_interrupted(result, options);
  print(study::text(result.plan, result.comparison));
  for (const std::string& name : result.comparison.missing)
    complain(fmt::format("warning: no cell has the measure '{}'\n", name));
  std::size_t failed = 0;
  for (std::size_t v = 0; v < result.plan.variants.size(); ++v) {
    const study::VariantSummary& variant = result.comparison.variants[v];
    if (variant.status == study::Status::ok) continue;
    if (++failed <= kMostReasons)
      print(fmt::format("{} {}: {}\n", result.plan.variants[v].id, name_of(variant.status),
                        variant.message));
  }
  print((out / "study.csv").string() + "\n" + (out / "study.json").string() + "\n");
  return failed > 0 ? kSomeFailed : 0;
}

void study_command(Options options) {
  if (!options.timeout.empty()) options.study.seconds = seconds_of(options.timeout);
  if (!options.memory.empty()) options.study.bytes = bytes_of(options.memory);
  if (options.study.out.empty()) options.study.out = options.graph.stem().string() + ".out";
  if (options.no_cache) {
    options.study.cache.clear();
  } else if (options.study.cache.empty()) {
    options.study.cache = run::default_cache_folder();
  }
  plugins::Registry registry;
  const graph::Loaded loaded = graph::load(options.graph, options.study.overrides, registry);
  if (!loaded.graph) {
    complain(graph::format(loaded.diagnostics));
    throw Exit{graph::exit_status(loaded.diagnostics)};
  }
  if (options.engine == "slurm") options.study.slurm = slurm_of(options);
  run::catch_signals();
  options.study.cancel = &run::stop_requested();
  if (loaded.graph->study && !options.study.resume && !options.study.slurm)
    complain("study: " +
             study::outlook(study::make_plan(*loaded.graph->study), options.study.out,
                            run::graph_name(options.graph), options.study.jobs) +
             "\n");
  options.study.note = [](const std::string& line) { complain("slurm: " + line + "\n"); };
  const study::StudyResult result =
      study::run_study(*loaded.graph, registry, options.study, Progress());
  int status = report(result, options.study);
  if (result.finished) {
    const int report_status = leave_report(options.study.out, registry);
    if (report_status != 0) status = report_status;
  }
  if (status != 0) throw Exit{status};
}

}  // namespace

void add_study(CLI::App& app) {
  auto options = std::make_shared<Options>();
  study::StudyOptions& study = options->study;
  CLI::App* command =
      app.add_subcommand("study", "Run every variant of a graph's study and compare");
  command->footer(kExamples);
  command->add_option("GRAPH", options->graph, "the graph, a TOML file with [study]")->required();
  command->add_option("--out", study.out, "output folder; default: <graph>.out here")
      ->type_name("DIR");
  command->add_option("--set", study.overrides, "node.param=VALUE: another value in every variant")
      ->type_name("TEXT")
      ->allow_extra_args(false);
  command->add_option("--jobs", study.jobs, "cells at a time; default: one for each processor")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  command->add_option("--threads", study.threads, "threads of a cell; default: what the jobs leave")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  command->add_option("--timeout", options->timeout, "longest time of a cell, as \"60 s\"")
      ->type_name("T");
  command->add_option("--memory", options->memory, "most memory of a cell, as \"2 GB\"")
      ->type_name("M");
  auto* cache = command->add_option("--cache", study.cache, "where results are kept and shared")
                    ->type_name("DIR");
  command->add_flag("--no-cache", options->no_cache, "every cell runs all of its nodes")
      ->excludes(cache);
  auto* resume =
      command->add_flag("--resume", study.resume, "run only the cells that have not ended yet");
  command->add_flag("--retry", study.retry, "run again what is not ok, too")->needs(resume);
  auto* engine =
      command
          ->add_option("--engine", options->engine, "where the cells run: local (default) or slurm")
          ->type_name("NAME")
          ->check(CLI::IsMember({"local", "slurm"}));
  command
      ->add_option("--slurm", options->slurm,
                   "KEY=VALUE of [study.slurm], as partition=short or time=\"2 h\"")
      ->type_name("TEXT")
      ->allow_extra_args(false)
      ->needs(engine);
  command->callback([options] { study_command(*options); });
}

}  // namespace velum::app
