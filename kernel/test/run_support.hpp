// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "folder.hpp"
#include "graph/graph.hpp"
#include "run/run.hpp"

/// Runs of graphs of the stages in test_plugins/.
namespace velum::test {

inline plugins::Registry& registry() {
  static plugins::Registry stages(plugins::Registry::Trust::open,
                                  {std::filesystem::path(VELUM_BINARY_DIR) / "test-plugins"});
  return stages;
}

inline graph::Graph load(const Folder& folder, const std::string& text) {
  graph::Loaded loaded =
      graph::load_text("units = \"m\"\n" + text, folder / "g.toml", {}, registry());
  if (!loaded.graph) throw std::runtime_error(graph::format(loaded.diagnostics));
  return std::move(*loaded.graph);
}

/// A node that most of these graphs begin with: 100 points.
inline const std::string kStart = "[node.start]\nuse = \"test.numbers\"\n";

/// The text with the first `from` replaced.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

inline run::RunOptions options_for(const Folder& folder) {
  run::RunOptions options;
  options.out = folder / "out";
  options.threads = 2;
  return options;
}

/// Runs into <folder>/out.
inline run::RunRecord run_text(const Folder& folder, const std::string& text,
                               const run::RunOptions& options) {
  run::Observer nobody;
  return run::run_graph(load(folder, text), registry(), options, nobody).record;
}
inline run::RunRecord run_text(const Folder& folder, const std::string& text) {
  return run_text(folder, text, options_for(folder));
}

inline double seconds_since(std::chrono::steady_clock::time_point began) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

/// The run, interrupted after `wait`.
inline run::RunRecord run_interrupted(const Folder& folder, const std::string& text,
                                      std::chrono::milliseconds wait) {
  std::atomic<bool> cancel = false;
  run::RunOptions options = options_for(folder);
  options.cancel = &cancel;
  const std::jthread interrupter([&] {
    std::this_thread::sleep_for(wait);
    cancel = true;
  });
  return run_text(folder, text, options);
}

inline const run::NodeRecord& node_of(const run::RunRecord& record, const std::string& name) {
  for (const run::NodeRecord& node : record.nodes)
    if (node.name == name) return node;
  throw std::runtime_error("no node " + name);
}
/// "ok", "cached", ... of each node, by name.
inline std::string statuses(const run::RunRecord& record) {
  std::string text;
  for (const run::NodeRecord& node : record.nodes)
    text += (text.empty() ? "" : " ") + node.name + "=" + std::string(run::name_of(node.status));
  return text;
}
inline std::string hash_of_node(const run::RunRecord& record, const std::string& name) {
  return node_of(record, name).out.at("cloud").at("hash").get<std::string>();
}

}  // namespace velum::test
