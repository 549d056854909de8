// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "graph/graph.hpp"
#include "plugins/registry.hpp"
#include "run/run.hpp"

/// Runs again what a record tells.
namespace velum::app {

/// A folder that goes when what is done in it is done.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The graph of a record, whose writers write to `out`; its mistakes where it is not sound any
/// more.
[[nodiscard]] graph::Loaded graph_of(const run::Json& record, const std::filesystem::path& out,
                                     plugins::Registry& registry);

/// Seed, nodes and threads of a record (`threads`, if above 0), without a cache, until Ctrl-C.
/// `name` is the record's in errors.
[[nodiscard]] run::RunOptions options_of(const run::Json& record, int threads,
                                         const std::filesystem::path& out, const std::string& name);

}  // namespace velum::app
