// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>

#include "graph/check.hpp"
#include "graph/graph.hpp"
#include "velum/files.hpp"

namespace velum::graph {
namespace {

namespace fs = std::filesystem;

/// Mistakes in the order of the files, and in each from top to bottom.
void sort(Diagnostics& diagnostics, const Document& document) {
  std::map<std::string, std::size_t> rank;
  for (const File& file : document.files) rank.emplace(file.source.name(), rank.size());
  std::ranges::stable_sort(diagnostics, {}, [&](const Diagnostic& diagnostic) {
    return std::pair(rank[diagnostic.file], diagnostic.where.begin);
  });
}

/// The nodes of a check without mistakes, in `order`, their wires renumbered.
std::vector<Node> in_order(std::vector<Checked>& nodes, const std::vector<std::size_t>& order) {
  std::vector<std::size_t> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  std::vector<Node> sorted;
  for (const std::size_t index : order) {
    Node& node = sorted.emplace_back(std::move(nodes[index].node));
    for (auto& input : node.inputs)
      for (Wire& wire : input) wire.node = place[wire.node];
  }
  return sorted;
}

Graph make_graph(Check& check, const fs::path& path, const std::vector<std::size_t>& order) {
  Graph graph;
  graph.path = path;
  graph.title = check.document.title;
  graph.units = check.document.units;
  graph.resolved = resolved_text(check);
  graph.nodes = in_order(check.nodes, order);
  return graph;
}

}  // namespace

std::optional<std::size_t> Graph::find(std::string_view name) const {
  const auto found = std::ranges::find(nodes, name, &Node::name);
  if (found == nodes.end()) return std::nullopt;
  return static_cast<std::size_t>(found - nodes.begin());
}

Loaded load_text(std::string text, const fs::path& path, const std::vector<std::string>& overrides,
                 Catalog& catalog, const LoadOptions& options) {
  Loaded loaded;
  auto document = read_document(std::move(text), path, overrides, loaded.diagnostics);
  if (!document) return loaded;
  if (options.variation != nullptr) vary(*document, *options.variation, loaded.diagnostics);
  Check check{*document, catalog, loaded.diagnostics, options};
  check_stages(check);
  check_settings(check);
  check_wires(check);
  check_files(check);
  check_together(check);
  const std::vector<std::size_t> order = check_order(check);
  check_needs(check, order);
  std::optional<Study> study = read_study(check);
  if (document->drafts.empty() && loaded.diagnostics.empty())
    Reporter(loaded.diagnostics, document->files.front().source)
        .error("E0105", {}, "the graph has no nodes", "write [node.NAME] with use = \"KIND.NAME\"");
  sort(loaded.diagnostics, *document);
  if (!loaded.diagnostics.empty()) return loaded;
  loaded.graph = make_graph(check, path, order);
  loaded.graph->study = std::move(study);
  return loaded;
}

Loaded load(const fs::path& path, const std::vector<std::string>& overrides, Catalog& catalog,
            const LoadOptions& options) {
  std::string text;
  try {
    text = FileContent(path, toml::kMaxBytes).text();
  } catch (const Error& error) {
    Loaded loaded;
    Reporter(loaded.diagnostics, Source(path.string(), "")).error("E0102", {}, error.what());
    return loaded;
  }
  return load_text(std::move(text), path, overrides, catalog, options);
}

}  // namespace velum::graph
