// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <unistd.h>

#include "graph/graph.hpp"
#include "run/run.hpp"

/// Runs of graphs of the stages in test_plugins/, in a folder that is gone after the test.
namespace velum::test {

class RunFolder {
 public:
  RunFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "velum-run-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~RunFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
    return path_ / name;
  }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path_ / name, std::ios::binary).rdbuf();
    return text.str();
  }

 private:
  std::filesystem::path path_;
};

inline plugins::Registry& registry() {
  static plugins::Registry stages(plugins::Registry::Trust::open,
                                  {std::filesystem::path(VELUM_BINARY_DIR) / "test-plugins"});
  return stages;
}

inline graph::Graph load(const RunFolder& folder, const std::string& text) {
  graph::Loaded loaded =
      graph::load_text("units = \"m\"\n" + text, folder / "g.toml", {}, registry());
  if (!loaded.graph) throw std::runtime_error(graph::format(loaded.diagnostics));
  return std::move(*loaded.graph);
}

inline run::RunOptions options_for(const RunFolder& folder) {
  run::RunOptions options;
  options.out = folder / "out";
  options.threads = 2;
  return options;
}

/// Runs into <folder>/out.
inline run::RunRecord run_text(const RunFolder& folder, const std::string& text,
                               const run::RunOptions& options) {
  run::Observer nobody;
  return run::run_graph(load(folder, text), registry(), options, nobody).record;
}
inline run::RunRecord run_text(const RunFolder& folder, const std::string& text) {
  return run_text(folder, text, options_for(folder));
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
