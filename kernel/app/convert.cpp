// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>

#include "commands.hpp"
#include "console.hpp"
#include "file_kind.hpp"
#include "plugins/registry.hpp"
#include "run/local_context.hpp"
#include "run/signals.hpp"
#include "run/single.hpp"
#include "run/summary.hpp"

namespace velum::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  fs::path in;
  fs::path out;
  std::string units;
};

void convert(const Options& options) {
  const FileKind from = kind_of_input(options.in);
  const FileKind to = kind_of_output(options.out, from);
  // A mesh that becomes a cloud is read as one: its vertices.
  const FileKind read = from == FileKind::mesh && to == FileKind::cloud ? to : from;
  run::catch_signals();
  run::LocalContext context({.threads = run::default_threads(),
                             .arena = 0,
                             .seed = 1,
                             .cancel = &run::stop_requested(),
                             .log = [](run::LocalContext::Level level, const std::string& message) {
                               if (level == run::LocalContext::Level::warning)
                                 complain("warning: " + message + "\n");
                             }});
  plugins::Registry registry;
  std::map<std::string, std::string> settings = {{"file", options.in.string()}};
  // STEP, IGES and recordings name their units.
  if (!options.units.empty() && read != FileKind::surface && read != FileKind::recording)
    settings["units"] = options.units;
  try {
    const Results results = run::run_single(registry, reader_of(read), settings, {}, context);
    const Value& value = results.at(0).value();
    settings["file"] = options.out.string();
    if (!options.units.empty()) settings["units"] = options.units;
    static_cast<void>(run::run_single(registry, writer_of(to), settings, {{value}}, context));
    print(fmt::format("{}: {}\n", options.out.string(), run::in_words(run::summarise(value))));
  } catch (const Cancelled&) {
    complain("interrupted; nothing was written\n");
    throw Exit{run::kInterrupted};
  }
}

}  // namespace

void add_convert(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("convert", "Any readable format to any writable one");
  command->footer("Example:\n  velum convert scan.pcd scan.ply --units mm");
  command->add_option("IN", options->in, "the file to read")->required();
  command->add_option("OUT", options->out, "the file to write; its ending names the format")
      ->required();
  command->add_option("--units", options->units, "unit of the lengths in both; default: m")
      ->type_name("U");
  command->callback([options] { convert(*options); });
}

}  // namespace velum::app
