// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>

#include "graph/graph.hpp"
#include "plugins/registry.hpp"
#include "study/journal.hpp"
#include "study/plan.hpp"

namespace velum::study {

/// What follows from a graph with a study before anything runs: the same for everybody who runs a
/// part of it.
struct Prepared {
  Plan plan;
  Journal::Heading heading;
  std::set<std::string> sources;  ///< of the graph
};

/// Nodes that take from no other.
[[nodiscard]] std::set<std::string> sources_of(const graph::Graph& graph);

/// Throws Error (Fault::graph) when one of these "node.parameter=VALUE" would be lost, because the
/// study varies it.
void require_effect(const graph::Study& study, const std::vector<std::string>& overrides);

/// Opens the plugins of all variants, as far as they are there, and reads the files that the study
/// names. Throws Error when there is no study, or one that cannot be planned. Without the files the
/// key is the first part of the study's key, for those who run a few cells of it.
[[nodiscard]] Prepared prepare(const graph::Graph& graph, plugins::Registry& registry,
                               bool with_files = true);

}  // namespace velum::study
