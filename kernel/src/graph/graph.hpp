// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "graph/catalog.hpp"
#include "graph/diagnostic.hpp"
#include "graph/study.hpp"
#include "graph/toml.hpp"
#include "velum/about.hpp"

namespace velum::graph {

/// One output of one node.
struct Wire {
  std::size_t node = 0;    ///< index into Graph::nodes
  std::size_t output = 0;  ///< index into its StageInfo::outputs
  bool operator==(const Wire&) const = default;
};

/// What an isolated node may use.
struct Limits {
  std::optional<double> seconds;
  std::optional<std::uint64_t> bytes;
  bool operator==(const Limits&) const = default;
};

/// A stage placed in a graph, checked.
struct Node {
  std::string name;
  std::string use;
  const StageInfo* info = nullptr;  ///< owned by the catalog
  std::string file;                 ///< of the graph (or included) file that says it
  toml::Region where;               ///< of its name there
  std::string title;
  std::vector<std::vector<Wire>> inputs;  ///< one a port of info->inputs; empty: not wired
  /// One a parameter of info->parameters, defaults filled in. Input files are absolute paths,
  /// output files relative to the run's output folder, a unit that was not given is that of the
  /// file.
  std::vector<Setting> settings;
  bool isolate = false;
  bool allow_empty = false;
  bool cache = true;
  std::optional<std::uint64_t> seed;
  Limits limits;
};

/// A graph without mistakes.
struct Graph {
  std::filesystem::path path;
  std::string title;
  std::string units;        ///< of the main file's bare lengths; "" when it does not say
  std::vector<Node> nodes;  ///< every node after those it takes from; the same order every time
  std::string resolved;     ///< as TOML: includes merged, overrides applied, units explicit
  std::optional<Study> study;

  /// Index of the node called `name`.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const;
};

struct LoadOptions {
  std::optional<std::filesystem::path> out;  ///< where outputs will go: checked to be writable
  const Variation* variation = nullptr;      ///< the graph of this variant, without its study
};

/// `graph` is there when there are no diagnostics.
struct Loaded {
  std::optional<Graph> graph;
  Diagnostics diagnostics;
};

/// Reads and checks a graph: every mistake in one go. Overrides are "node.parameter=VALUE", the
/// value as TOML or bare text. Throws nothing for anything that a file may contain.
[[nodiscard]] Loaded load(const std::filesystem::path& path,
                          const std::vector<std::string>& overrides, Catalog& catalog,
                          const LoadOptions& options = {});
/// The same for text that is in no file: `path` names it, and its folder is that of relative paths.
[[nodiscard]] Loaded load_text(std::string text, const std::filesystem::path& path,
                               const std::vector<std::string>& overrides, Catalog& catalog,
                               const LoadOptions& options = {});

}  // namespace velum::graph
