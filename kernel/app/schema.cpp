// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "graph/schema.hpp"

#include "commands.hpp"
#include "console.hpp"
#include "plugins/registry.hpp"

namespace velum::app {

void add_schema(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("schema", "A JSON Schema of graphs, for completion in editors");
  command->footer("Example:\n  velum schema > graph.schema.json");
  command->callback([] {
    plugins::Registry registry;
    print(graph::schema(registry) + "\n");
  });
}

}  // namespace velum::app
