// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "run/run.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "run/output_folder.hpp"
#include "run/signals.hpp"
#include "velum/files.hpp"

namespace velum::run {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::string now() {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(seconds)));
}

// The files that the nodes say they will write, relative to the output folder.
std::vector<std::string> planned_files(const graph::Graph& graph) {
  std::vector<std::string> files;
  for (const graph::Node& node : graph.nodes)
    for (std::size_t i = 0; i < node.settings.size(); ++i)
      if (node.info->parameters[i].type == ParameterType::output_file)
        if (const auto* file = std::get_if<std::string>(&node.settings[i].value))
          files.push_back(*file);
  return files;
}

// Before the output folder is touched.
void check_chosen(const graph::Graph& graph, const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const graph::Node& node : graph.nodes) known.push_back(node.name);
  for (const std::string& name : names) {
    if (graph.find(name)) continue;
    const std::string guess = graph::did_you_mean(name, known);
    throw Error(Fault::graph, fmt::format("the graph has no node '{}'", name))
        .at(graph.path.string())
        .hint(guess.empty() ? graph::known_list(known) : guess);
  }
}

Status status_of(const RunRecord& record, Ended ended) {
  if (record.failure) return Status::failed;
  const bool whole =
      std::all_of(record.nodes.begin(), record.nodes.end(), [](const NodeRecord& node) {
        return node.status == Status::ok || node.status == Status::cached;
      });
  // Interrupted when everything was done already: done.
  return ended == Ended::done || whole ? Status::ok : Status::interrupted;
}

/// What the record says besides what the nodes did.
class Frame {
 public:
  Frame(const graph::Graph& graph, const RunOptions& options) {
    record_.graph_path = graph_name(graph.path);
    record_.graph_title = graph.title;
    record_.graph_resolved = graph.resolved;
    record_.started = now();
    record_.threads = options.threads;
    record_.seed = options.seed;
  }
  [[nodiscard]] RunRecord around(RunRecord nodes) const {
    RunRecord record = record_;
    record.nodes = std::move(nodes.nodes);
    record.files = std::move(nodes.files);
    record.inputs = std::move(nodes.inputs);
    record.failure = std::move(nodes.failure);
    record.peak_bytes = nodes.peak_bytes;
    record.seconds = std::chrono::duration<double>(Clock::now() - began_).count();
    record.cpu_seconds = cpu_seconds() - cpu_;
    return record;
  }

 private:
  Clock::time_point began_ = Clock::now();
  double cpu_ = cpu_seconds();
  RunRecord record_;
};

// The next run would take a cache in the output folder for somebody's files.
void refuse_cache_within(const RunOptions& options) {
  if (options.cache.empty()) return;
  const fs::path out = fs::weakly_canonical(fs::absolute(options.out));
  const fs::path cache = fs::weakly_canonical(fs::absolute(options.cache));
  if (std::mismatch(out.begin(), out.end(), cache.begin(), cache.end()).first == out.end())
    throw Error(Fault::graph, "the cache lies in the output folder")
        .at(cache.string())
        .hint("choose another folder with --cache or --out");
}

}  // namespace

RunResult run_graph(const graph::Graph& graph, plugins::Registry& registry,
                    const RunOptions& options, Observer& observer,
                    const std::function<void(const RunRecord&)>& started) {
  check_chosen(graph, options.only);
  const Frame frame(graph, options);
  refuse_cache_within(options);
  OutputFolder folder(options.out, graph_name(graph.path), planned_files(graph), options.others);
  std::optional<Cache> cache;
  if (!options.cache.empty()) cache.emplace(options.cache, options.cache_limit);
  auto executor =
      std::make_unique<Executor>(graph, registry,
                                 ExecuteOptions{.out = folder.path(),
                                                .scratch = [&folder] { return folder.scratch(); },
                                                .threads = options.threads,
                                                .seed = options.seed,
                                                .only = options.only,
                                                .cache = cache ? &*cache : nullptr,
                                                .cancel = options.cancel,
                                                .witnesses = options.witnesses},
                                 observer);
  if (started) started(frame.around(executor->record()));
  const Ended ended = executor->run();

  RunResult result;
  result.record = frame.around(executor->record());
  result.record.status = status_of(result.record, ended);
  result.record_file = folder.path() / kRecordName;
  result.abandoned = ended == Ended::abandoned;
  // Its threads are in a stage that does not return; the process ends with them.
  if (result.abandoned) static_cast<void>(executor.release());
  write_file(result.record_file, dump(to_json(result.record), 1) + "\n");
  if (options.recorded) options.recorded(result);
  if (cache && !result.abandoned) cache->trim();
  return result;
}

int exit_status(const RunRecord& record) {
  if (record.status == Status::interrupted) return kInterrupted;
  return record.failure ? static_cast<int>(record.failure->fault) : 0;
}

std::string graph_name(const fs::path& graph) {
  return fs::weakly_canonical(fs::absolute(graph)).string();
}

}  // namespace velum::run
