// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "again.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "run/signals.hpp"

namespace velum::app {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "velum-rerun-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw Error(Fault::output, "no temporary folder can be made").at(name);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

graph::Loaded graph_of(const run::Json& record, const fs::path& out, plugins::Registry& registry) {
  const run::Json& graph = record.at("graph");
  return graph::load_text(graph.at("resolved").get<std::string>(),
                          graph.at("path").get<std::string>(), {}, registry, {.out = out});
}

run::RunOptions options_of(const run::Json& record, int threads, const fs::path& out,
                           const std::string& name) {
  run::RunOptions result;
  result.out = out;
  result.threads = threads > 0 ? threads : record.at("threads").get<int>();
  if (result.threads < 1)
    throw Error(Fault::input, fmt::format("its threads are {}; there must be one", result.threads))
        .at(name);
  result.seed = record.at("seed").get<std::uint64_t>();
  for (const run::Json& node : record.at("nodes"))
    result.only.push_back(node.at("name").get<std::string>());
  result.cancel = &run::stop_requested();
  return result;
}

}  // namespace velum::app
