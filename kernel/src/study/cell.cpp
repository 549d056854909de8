// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>

#include "files/descriptor.hpp"
#include "graph/place.hpp"
#include "run/node_error.hpp"
#include "run/run.hpp"
#include "study/cell_views.hpp"
#include "study/prepare.hpp"
#include "velum/files.hpp"

namespace velum::study {
namespace {

bool is_usage(const std::string& measure) {
  return measure == "seconds" || measure == "cpu_seconds" || measure == "peak_bytes";
}

/// A node whose time or memory is a measure runs in every cell.
void run_what_is_timed(graph::Graph& graph, const graph::Study& study) {
  for (const graph::MeasureName& measure : study.measures) {
    if (!is_usage(measure.name)) continue;
    for (graph::Node& node : graph.nodes)
      if (measure.node == "total" || measure.node == node.name) node.cache = false;
  }
}

template <class Record>
std::optional<Figure> usage(const Record& record, const std::string& name) {
  const auto seconds = [](std::optional<double> x) -> std::optional<Figure> {
    return x ? std::optional(Figure{*x, "s", Better::lower}) : std::nullopt;
  };
  if (name == "seconds") return seconds(record.seconds);
  if (name == "cpu_seconds") return seconds(record.cpu_seconds);
  const std::optional<std::uint64_t> bytes = record.peak_bytes;
  if (name != "peak_bytes" || !bytes) return std::nullopt;
  return Figure{static_cast<double>(*bytes), "B", Better::lower};
}

std::optional<Figure> figure(const run::RunRecord& record, const graph::MeasureName& name) {
  if (name.node == "total") return usage(record, name.name);
  const auto node = std::ranges::find(record.nodes, name.node, &run::NodeRecord::name);
  if (node == record.nodes.end()) return std::nullopt;
  if (is_usage(name.name)) return usage(*node, name.name);
  const auto measure = node->measures.find(name.name);
  if (measure == node->measures.end()) return std::nullopt;
  return Figure{measure->second.value, measure->second.unit, measure->second.better};
}

/// Hash of what the sources gave. A source that only this variant has, a helper of an alternative,
/// counts where it gives what no source of the graph does.
std::string source_hash(const run::RunRecord& record, const std::set<std::string>& of_graph,
                        const std::set<std::string>& of_variant) {
  std::string all;
  std::set<std::string> given;
  std::set<std::string> more;
  for (const run::NodeRecord& node : record.nodes)
    for (const auto& [port, value] : node.out.items()) {
      if (!value.is_object()) continue;  // null where the source left an output out
      const std::string hash = value.value("hash", "");
      if (of_graph.contains(node.name)) {
        all += fmt::format("{}.{} {}\n", node.name, port, hash);
        given.insert(hash);
      } else if (of_variant.contains(node.name)) {
        more.insert(hash);
      }
    }
  for (const std::string& hash : more)
    if (!given.contains(hash)) all += hash + "\n";
  return hash_of(std::as_bytes(std::span(all)));
}

Status status_of(const std::string& code) {
  if (code == run::kEmptyResult) return Status::empty;
  if (code == run::kCrashed) return Status::crashed;
  if (code == run::kTooLong) return Status::timed_out;
  if (code == run::kTooMuchMemory) return Status::out_of_memory;
  return Status::failed;
}

Outcome outcome_of(const run::RunRecord& record, const Plan& plan, const Setup& setup,
                   const graph::Graph& graph) {
  if (record.status == run::Status::interrupted) throw Cancelled();
  Outcome outcome;
  outcome.status = Status::ok;
  outcome.seconds = record.seconds;
  outcome.peak_bytes = record.peak_bytes;
  outcome.source = source_hash(record, setup.sources, sources_of(graph));
  if (record.failure) {
    outcome.status = status_of(record.failure->code);
    outcome.message = fmt::format("{} ({}): {}", record.failure->node, record.failure->stage,
                                  record.failure->message);
    return outcome;
  }
  for (const graph::MeasureName& name : plan.study.measures)
    if (const auto found = figure(record, name)) outcome.figures[name.full()] = *found;
  return outcome;
}

Outcome invalid(const graph::Diagnostics& diagnostics) {
  const graph::Diagnostic& first = diagnostics.front();
  Outcome outcome;
  outcome.status = Status::invalid;
  outcome.message = fmt::format("{} {}", graph::place_of(first), first.message);
  if (diagnostics.size() > 1)
    outcome.message += fmt::format(", and {} more", diagnostics.size() - 1);
  return outcome;
}

}  // namespace

std::filesystem::path folder_of(const Plan& plan, const Cell& cell) {
  return std::filesystem::path("cells") / plan.variants[cell.variant].id /
         fmt::format("{}", cell.repeat + 1);
}

void require_room(const Outcome& outcome, const std::filesystem::path& folder) {
  for (const int reason : {ENOSPC, EDQUOT})
    if (outcome.status != Status::ok &&
        outcome.message.find(files::reason(reason)) != std::string::npos)
      throw Error(Fault::output, outcome.message)
          .at(folder.string())
          .hint("make room on the disk; --resume goes on from here");
}

Outcome run_cell(const Plan& plan, const Cell& cell, const Setup& setup,
                 plugins::Registry& registry) {
  const graph::Variation variation = plan.variation(plan.variants[cell.variant]);
  run::RunOptions options;
  options.out = setup.out / folder_of(plan, cell);
  options.threads = setup.threads;
  options.seed = plan.study.seeds[cell.repeat];
  options.cache = setup.cache;
  options.cancel = setup.cancel;
  try {
    graph::Loaded loaded = graph::load_text(setup.text, setup.graph, setup.overrides, registry,
                                            {.out = options.out, .variation = &variation});
    if (!loaded.graph) return invalid(loaded.diagnostics);
    run_what_is_timed(*loaded.graph, plan.study);
    CellViews views(plan, cell, *loaded.graph, options.out, setup.threads);
    views.ask(options);
    run::Observer nobody;
    const auto result = run::run_graph(*loaded.graph, registry, options, nobody);
    return outcome_of(result.record, plan, setup, *loaded.graph);
  } catch (const Error& error) {
    Outcome outcome;
    outcome.message = plugins::one_line(error);
    return outcome;
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& error) {
    Outcome outcome;
    outcome.message = error.what();
    return outcome;
  }
}

}  // namespace velum::study
