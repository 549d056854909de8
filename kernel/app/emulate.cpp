// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <map>
#include <memory>

#include "commands.hpp"
#include "console.hpp"
#include "plugins/registry.hpp"
#include "run/local_context.hpp"
#include "run/signals.hpp"
#include "run/single.hpp"

namespace velum::app {
namespace {

constexpr const char* kExamples = R"(Examples:
  velum emulate scenes/wind_tunnel.toml --scanner gennaker
  velum emulate scene.toml --port 3111 --frequency 100 --resolution 0.1667
  velum emulate scene.toml --set fault=split --set fault_after=0

CoLa A is on the port, CoLa B on the next one. When it prints `listening`, clients can connect; it
serves until Ctrl-C. `velum describe devices.emulator` has all that can be set.)";

struct Options {
  std::string scene;
  std::map<std::string, std::string> settings;
  std::vector<std::string> more;
};

std::map<std::string, std::string> settings_of(const Options& options) {
  auto settings = options.settings;
  std::erase_if(settings, [](const auto& one) { return one.second.empty(); });
  settings["scene"] = options.scene;
  for (const std::string& one : options.more) {
    const auto equals = one.find('=');
    if (equals == std::string::npos)
      throw Error(Fault::graph, "'" + one + "' sets nothing; expected parameter=VALUE");
    settings[one.substr(0, equals)] = one.substr(equals + 1);
  }
  return settings;
}

void emulate(const Options& options) {
  run::catch_signals();
  run::LocalContext context({.threads = 1,
                             .arena = 0,
                             .seed = 1,
                             .cancel = &run::stop_requested(),
                             .log = [](run::LocalContext::Level level, const std::string& message) {
                               if (level == run::LocalContext::Level::warning)
                                 complain("warning: " + message + "\n");
                               else
                                 print(message + "\n");
                             }});
  plugins::Registry registry;
  try {
    static_cast<void>(
        run::run_single(registry, "devices.emulator", settings_of(options), {}, context));
  } catch (const Cancelled&) {
    throw Exit{run::kInterrupted};
  }
}

}  // namespace

void add_emulate(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("emulate", "An LMS 511 on loopback, made of a scene");
  command->footer(kExamples);
  command->add_option("SCENE", options->scene, "the scene, a TOML file")->required();
  const auto add = [&](const std::string& name, const std::string& doc, const std::string& type) {
    command->add_option("--" + name, options->settings[name], doc)->type_name(type);
  };
  add("scanner", "which of the scene's scanners; needed where it has several", "NAME");
  add("port", "of CoLa A; default: 2111", "N");
  add("frequency", "of the mirror [Hz]; default: 25", "F");
  add("resolution", "angle between beams [deg]; default: the scene's", "A");
  add("speed", "times real time; 0: as fast as clients take it; default: 1", "X");
  add("fault", "how it misbehaves: split, silence, reset, garbage, ...", "NAME");
  command->add_option("--set", options->more, "param=VALUE: any other parameter")
      ->type_name("TEXT")
      ->allow_extra_args(false);
  command->callback([options] { emulate(*options); });
}

}  // namespace velum::app
