// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/cell_views.hpp"

#include <algorithm>

#include "report/study_report.hpp"
#include "report/views_file.hpp"
#include "run/output_folder.hpp"
#include "run/run.hpp"
#include "velum/files.hpp"

namespace velum::study {
namespace {

namespace fs = std::filesystem;

bool has_shape(const graph::Node& node) {
  return std::ranges::any_of(node.info->outputs, [](const Port& port) {
    return std::ranges::any_of(port.types, [](ValueType type) {
      return type == ValueType::cloud || type == ValueType::mesh || type == ValueType::surface ||
             type == ValueType::clusters;
    });
  });
}

/// Of all arrays of one variant: what leaves room for those of all that are shown.
std::uint64_t limit_of(const Plan& plan) {
  constexpr std::uint64_t kMost = 2'000'000;
  const std::size_t variants = std::min(plan.variants.size(), report::kMostVariants);
  return std::min(kMost, report::kRunLimit / variants);
}

/// An earlier repeat that is ok has left its views.
bool shown_already(const fs::path& folder, const Cell& cell) {
  for (std::size_t repeat = 0; repeat < cell.repeat; ++repeat) {
    std::error_code failed;
    const fs::path other = folder.parent_path() / std::to_string(repeat + 1);
    if (fs::exists(other / run::kViewsName, failed)) return true;
  }
  return false;
}

}  // namespace

std::set<std::string> shown_nodes(const Plan& plan, const graph::Graph& graph) {
  std::set<std::string> varied;
  for (const graph::Axis& axis : plan.study.axes)
    for (const graph::Choice& choice : axis.choices) {
      for (const auto& each : choice.variation.alternatives) varied.insert(each.node);
      for (const auto& each : choice.variation.values) varied.insert(each.node);
    }
  std::set<std::string> shown;
  std::vector<bool> continued(graph.nodes.size(), false);
  for (const graph::Node& node : graph.nodes) {
    if (!has_shape(node)) continue;
    for (const auto& input : node.inputs)
      for (const graph::Wire& wire : input) continued[wire.node] = true;
  }
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const graph::Node& node = graph.nodes[i];
    if (has_shape(node) && (!continued[i] || varied.contains(node.name))) shown.insert(node.name);
  }
  return shown;
}

CellViews::CellViews(const Plan& plan, const Cell& cell, const graph::Graph& graph,
                     const fs::path& folder, int threads) {
  if (cell.variant >= report::kMostVariants || shown_already(folder, cell)) return;
  std::set<std::string> nodes = shown_nodes(plan, graph);
  if (nodes.empty()) return;
  watch_ = std::make_unique<report::ViewWatch>(graph, limit_of(plan), threads, std::move(nodes));
}

void CellViews::ask(run::RunOptions& options) {
  if (!watch_) return;
  options.witnesses.push_back(watch_.get());
  options.recorded = [this](const run::RunResult& result) {
    if (result.record.status == run::Status::ok) leave(result.record_file.parent_path());
  };
}

// A cell without its views is as good a cell; the report then has nothing to show of it.
void CellViews::leave(const fs::path& folder) const {
  try {
    const std::string record = hash_of(FileContent(folder / run::kRecordName).bytes());
    report::write_views(folder / run::kViewsName, {record, watch_->views().all()});
  } catch (const std::exception&) {
  }
}

}  // namespace velum::study
