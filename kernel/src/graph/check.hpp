// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "graph/document.hpp"
#include "graph/graph.hpp"

namespace velum::graph {

/// A wire with its place in the graph.
struct PlacedWire {
  Wire wire;
  toml::Region where;
  const File* file = nullptr;
};

/// What is found out about the draft of the same index.
struct Checked {
  Node node;                                   ///< info is null when the stage is not known
  std::vector<const Key*> given;               ///< one a parameter; null: the default
  std::vector<std::vector<PlacedWire>> wires;  ///< one an input
  bool all_read = false;  ///< every parameter that the stage has is right by itself
};

/// The state of a check, handed from one step to the next. A step that finds a mistake reports it
/// and leaves out what it concerns, so that nothing is reported twice.
struct Check {
  const Document& document;
  Catalog& catalog;
  Diagnostics& diagnostics;
  const LoadOptions& options;
  std::vector<Checked> nodes = {};  ///< one a draft

  [[nodiscard]] Reporter report(const Key& key) const {
    return Reporter(diagnostics, key.file->source);
  }
  [[nodiscard]] Reporter report(const Draft& draft) const {
    return Reporter(diagnostics, draft.file->source);
  }
};

/// "node 'sail' (resampling.mls)".
[[nodiscard]] std::string call(const Node& node);

// The steps, in this order.
/// `use`, and the keys that belong to the node.
void check_stages(Check& check);
/// Parameters.
void check_settings(Check& check);
/// `in`.
void check_wires(Check& check);
/// Files to read and to write.
void check_files(Check& check);
/// What the stages themselves say of parameters that are right one by one; files have their paths.
void check_together(Check& check);
/// The indices of the nodes, each after those it takes from, by name where free. Cycles are
/// reported, and what is behind one is left out.
[[nodiscard]] std::vector<std::size_t> check_order(Check& check);
/// Columns that inputs need, of the nodes in `order`.
void check_needs(Check& check, const std::vector<std::size_t>& order);
/// [study], where there is one; what is returned is whole when nothing was reported.
[[nodiscard]] std::optional<Study> read_study(const Check& check);

/// A value as TOML, on one line.
[[nodiscard]] std::string value_text(const toml::Node& value);
/// The graph as TOML that says the same without includes and overrides.
[[nodiscard]] std::string resolved_text(const Check& check);

}  // namespace velum::graph
