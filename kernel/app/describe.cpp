// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "commands.hpp"
#include "console.hpp"
#include "plugins/describe.hpp"
#include "plugins/registry.hpp"

namespace velum::app {
namespace {

struct Options {
  std::string stage;
  bool json = false;
};

void describe(const Options& options) {
  plugins::Registry registry;
  const StageInfo& info = registry.stage(options.stage).info();
  const std::string example = plugins::example_beside(registry.file(options.stage));
  print(options.json ? plugins::describe_json(info, example).dump(2) + "\n"
                     : plugins::describe_text(info, example));
}

}  // namespace

void add_describe(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("describe", "What a stage takes, gives and can be set to; an example");
  command->add_option("STAGE", options->stage, "the stage, such as registration.icp")->required();
  command->add_flag("--json", options->json, "for programs");
  command->callback([options] { describe(*options); });
}

}  // namespace velum::app
