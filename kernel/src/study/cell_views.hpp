// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <string>

#include "report/watch.hpp"
#include "run/run.hpp"
#include "study/plan.hpp"

namespace velum::study {

/// What a study's report shows of one cell: the clouds and meshes of the nodes that vary, and those
/// that no other node makes more of. One cell of a variant leaves it, in views.bin beside run.json.
class CellViews {
 public:
  /// `graph` is that of the variant; `folder` the cell's.
  CellViews(const Plan& plan, const Cell& cell, const graph::Graph& graph,
            const std::filesystem::path& folder, int threads);

  /// Does nothing where another cell shows the variant already, or none is to.
  void ask(run::RunOptions& options);

 private:
  void leave(const std::filesystem::path& folder) const;

  std::unique_ptr<report::ViewWatch> watch_;
};

/// The nodes of a variant's graph that its report shows.
[[nodiscard]] std::set<std::string> shown_nodes(const Plan& plan, const graph::Graph& graph);

}  // namespace velum::study
