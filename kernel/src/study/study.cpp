// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <set>
#include <span>

#include "files/descriptor.hpp"
#include "run/run.hpp"
#include "study/cell.hpp"
#include "study/folder.hpp"
#include "study/journal.hpp"
#include "study/pool.hpp"
#include "study/tables.hpp"
#include "velum/files.hpp"

namespace velum::study {
namespace {

/// The stages that some variant uses, as far as they are there: opening them here saves every cell
/// from doing it.
std::set<std::string> stages_of(const graph::Graph& graph, const graph::Study& study,
                                plugins::Registry& registry) {
  std::set<std::string> stages;
  for (const graph::Node& node : graph.nodes) stages.insert(node.use);
  const auto add = [&](const graph::toml::Node& keys) {
    if (const auto* use = keys.find("use")) stages.insert(use->value.text);
  };
  for (const graph::Axis& axis : study.axes)
    for (const graph::Choice& choice : axis.choices)
      for (const auto& alternative : choice.variation.alternatives) {
        add(alternative.keys);
        if (const auto* with = alternative.keys.find("with"))
          for (const auto& helper : with->value.entries) add(helper.value);
      }
  std::erase_if(stages, [&](const std::string& id) { return registry.find(id) == nullptr; });
  return stages;
}

/// Of all that decides what the cells give.
std::string key_of(const graph::Graph& graph, const std::set<std::string>& stages,
                   plugins::Registry& registry) {
  std::string all = std::string(kVersion) + "\n" + graph.resolved;
  for (const std::string& id : stages) all += id + " " + registry.file_hash(id) + "\n";
  const auto add_file = [&](const std::string& name) {
    const std::filesystem::path file = graph.path.parent_path() / name;
    std::error_code none;
    if (std::filesystem::is_regular_file(file, none))
      all += name + " " + hash_of(FileContent(file).bytes()) + "\n";
  };
  for (const graph::Node& node : graph.nodes)
    for (std::size_t i = 0; i < node.settings.size(); ++i)
      if (node.info->parameters[i].type == ParameterType::input_file)
        if (const auto* name = std::get_if<std::string>(&node.settings[i].value)) add_file(*name);
  for (const graph::Axis& axis : graph.study->axes)
    for (const graph::Choice& choice : axis.choices) {
      all += axis.name + "=" + choice.label + "\n";
      for (const auto& value : choice.variation.values) add_file(value.value.text);
    }
  return hash_of(std::as_bytes(std::span(all)));
}

/// A full disk is no result of a cell.
void require_room(const Outcome& outcome, const std::filesystem::path& folder) {
  for (const int reason : {ENOSPC, EDQUOT})
    if (outcome.status != Status::ok &&
        outcome.message.find(files::reason(reason)) != std::string::npos)
      throw Error(Fault::output, outcome.message)
          .at(folder.string())
          .hint("make room on the disk; --resume goes on from here");
}

std::set<std::string> sources_of(const graph::Graph& graph) {
  std::set<std::string> sources;
  for (const graph::Node& node : graph.nodes)
    if (std::ranges::all_of(node.inputs, [](const auto& wires) { return wires.empty(); }))
      sources.insert(node.name);
  return sources;
}

/// Repeat by repeat, so that all variants are known a little before one is known well.
std::vector<Cell> cells_left(const Plan& plan, const Outcomes& known) {
  std::vector<Cell> left;
  for (std::size_t r = 0; r < plan.study.seeds.size(); ++r)
    for (std::size_t v = 0; v < plan.variants.size(); ++v)
      if (!known.contains({v, r})) left.push_back({v, r});
  return left;
}

PoolOptions pool_options(const StudyOptions& options, const graph::Study& study) {
  PoolOptions pool;
  pool.jobs = study.exclusive ? 1 : options.jobs > 0 ? options.jobs : run::default_threads();
  pool.seconds = options.seconds ? options.seconds : study.seconds;
  pool.bytes = options.bytes ? options.bytes : study.bytes;
  pool.cancel = options.cancel;
  return pool;
}

}  // namespace

StudyResult run_study(const graph::Graph& graph, plugins::Registry& registry,
                      const StudyOptions& options, const CellEnded& ended) {
  if (!graph.study)
    throw Error(Fault::graph, "the graph has no study")
        .at(graph.path.string())
        .hint("add [study] with measure = [...] and [[study.vary]]");
  StudyResult result{make_plan(*graph.study), {}, false, 0};
  const Plan& plan = result.plan;
  const std::set<std::string> stages = stages_of(graph, plan.study, registry);
  const Journal::Heading heading{run::graph_name(graph.path), key_of(graph, stages, registry)};
  const Folder folder(options.out, heading, options.resume);
  Journal journal(folder.path() / kJournalName, heading);

  const PoolOptions pool = pool_options(options, plan.study);
  const Setup setup{.graph = graph.path,
                    .text = std::string(FileContent(graph.path).text()),
                    .overrides = options.overrides,
                    .out = folder.path(),
                    .cache = options.cache,
                    .threads = options.threads > 0
                                   ? options.threads
                                   : std::max(1, run::default_threads() / pool.jobs),
                    .sources = sources_of(graph),
                    .cancel = options.cancel};
  result.finished = run_cells(
      cells_left(plan, journal.outcomes()), pool,
      [&](const Cell& cell) {
        return Process([&, cell] { return run_cell(plan, cell, setup, registry); },
                       folder.path() / (folder_of(plan, cell).string() + ".log"));
      },
      [&](const Cell& cell, const Outcome& outcome) {
        require_room(outcome, folder.path());
        journal.add(cell, outcome);
        ended(plan, cell, outcome, journal.outcomes().size());
      });
  result.done = journal.outcomes().size();
  if (!result.finished) return result;
  result.comparison = compare(plan, journal.outcomes());
  write_file(folder.path() / "study.csv", csv(plan, journal.outcomes(), result.comparison));
  write_file(folder.path() / "study.json",
             run::dump(json(plan, journal.outcomes(), result.comparison, heading.graph), 1) + "\n");
  return result;
}

}  // namespace velum::study
