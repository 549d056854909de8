// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "commands.hpp"
#include "console.hpp"
#include "plugins/scaffold.hpp"

namespace velum::app {
namespace {

struct Options {
  std::string id;
  std::filesystem::path folder = ".";
};

void make_new(const Options& options) {
  const plugins::Scaffold made = plugins::new_plugin(options.id, options.folder);
  for (const auto& file : made.files) print(file.string() + "\n");
  if (made.in_checkout) {
    print(fmt::format("\nbuild and test it:\n  make build && ctest --preset release -R {}\n",
                      options.id));
  } else {
    print(
        fmt::format("\nbuild and test it:\n  cd {}\n  cmake -B build && cmake --build build && "
                    "ctest --test-dir build --output-on-failure\nuse it:\n"
                    "  VELUM_PLUGIN_PATH=$PWD/build/plugins velum run example.toml\n",
                    made.folder.string()));
  }
}

}  // namespace

void add_new(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "new",
      "A new plugin that builds and passes its test: in a checkout of Velum beside the "
      "others, elsewhere as a project of its own");
  command->add_option("KIND.NAME", options->id, "the stage, such as resampling.my_method")
      ->required();
  command->add_option("--dir", options->folder, "make it here instead of in the working directory")
      ->type_name("DIR");
  command->callback([options] { make_new(*options); });
}

}  // namespace velum::app
