// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "commands.hpp"
#include "console.hpp"
#include "graph/graph.hpp"
#include "plugins/registry.hpp"
#include "run/run.hpp"
#include "study/estimate.hpp"
#include "study/plan.hpp"

namespace velum::app {
namespace {

struct Options {
  std::filesystem::path graph;
  std::vector<std::string> overrides;
};

void check(const Options& options) {
  plugins::Registry registry;
  const graph::Loaded loaded = graph::load(options.graph, options.overrides, registry);
  if (!loaded.graph) {
    complain(graph::format(loaded.diagnostics));
    throw Exit{graph::exit_status(loaded.diagnostics)};
  }
  std::optional<study::Plan> plan;
  if (loaded.graph->study) plan = study::make_plan(*loaded.graph->study);
  const std::size_t nodes = loaded.graph->nodes.size();
  print(fmt::format("{}: no mistakes, {} node{}\n", options.graph.string(), nodes,
                    nodes == 1 ? "" : "s"));
  if (plan)
    print("study: " +
          study::outlook(*plan, options.graph.stem().string() + ".out",
                         run::graph_name(options.graph), 0) +
          "\n");
}

}  // namespace

void add_check(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("check", "Find every mistake in a graph; runs nothing");
  command->add_option("GRAPH", options->graph, "the graph, a TOML file")->required();
  command->add_option("--set", options->overrides, "node.param=VALUE, as for `velum run`")
      ->type_name("TEXT")
      ->allow_extra_args(false);
  command->callback([options] { check(*options); });
}

}  // namespace velum::app
