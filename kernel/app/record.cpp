// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

#include "commands.hpp"
#include "console.hpp"
#include "graph/graph.hpp"
#include "plugins/registry.hpp"
#include "run/local_context.hpp"
#include "run/signals.hpp"
#include "run/single.hpp"

namespace velum::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExamples = R"(Examples:
  velum record 192.168.0.1 --out sweep.vrec                  until Ctrl-C
  velum record lms.local:2111 --out sweep.vrec --set duration="20 s" --set encoding=cola_a
  velum record sweep.toml --out sweep.vrec                   as the graph's scanner is set

What was recorded before Ctrl-C, a kill or a full disk can be replayed: devices.replay.)";

constexpr const char* kStage = "devices.recorder";
constexpr std::string_view kViewMark = "[live view]";

struct Options {
  std::string from;
  fs::path out;
  std::vector<std::string> settings;
  double rotate = 0.0;
  bool force = false;
  bool quiet = false;
};

using Settings = std::map<std::string, std::string>;

// NAME=VALUE; NODE.NAME=VALUE is taken too.
void add_setting(Settings& settings, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw Error(Fault::graph, fmt::format("'{}' is no setting, expected NAME=VALUE", text));
  const std::size_t dot = text.rfind('.', equals);
  const std::size_t begin = dot == std::string::npos ? 0 : dot + 1;
  settings[text.substr(begin, equals - begin)] = text.substr(equals + 1);
}

// A value as it would stand in a graph; nothing for one that is not set.
std::string in_toml(const Setting& setting) {
  const auto text = [](const auto& value) -> std::string {
    using V = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<V, bool>)
      return value ? "true" : "false";
    else if constexpr (std::is_same_v<V, std::int64_t> || std::is_same_v<V, double>)
      return fmt::format("{}", value);
    else if constexpr (std::is_same_v<V, std::string>)
      return value;
    else
      return "";
  };
  return std::visit(text, setting.value);
}

// The scanner of a graph: the parameters that its first devices.lms511 or devices.recorder shares
// with the recorder.
void add_graph(Settings& settings, const fs::path& path, plugins::Registry& registry,
               const StageInfo& recorder) {
  const graph::Loaded loaded = graph::load(path, {}, registry);
  if (!loaded.graph) {
    complain(graph::format(loaded.diagnostics));
    throw Exit{graph::exit_status(loaded.diagnostics)};
  }
  for (const graph::Node& node : loaded.graph->nodes) {
    if (node.use != "devices.lms511" && node.use != kStage) continue;
    const StageInfo& info = *node.info;
    for (std::size_t i = 0; i < info.parameters.size(); ++i) {
      const Parameter& own = info.parameters[i];
      const bool shared =
          own.name != "file" && std::any_of(recorder.parameters.begin(), recorder.parameters.end(),
                                            [&](const Parameter& p) { return p.name == own.name; });
      const std::string value = shared ? in_toml(node.settings[i]) : "";
      if (value.empty()) continue;
      const char* unit = own.type == ParameterType::angle      ? " rad"
                         : own.type == ParameterType::duration ? " s"
                                                               : "";
      settings[own.name] = value + unit;
    }
    return;
  }
  throw Error(Fault::graph, "the graph has no node of devices.lms511 or devices.recorder")
      .at(path.string());
}

// Draws the recorder's picture where the last one was.
class Picture {
 public:
  void draw(std::string_view text) {
    text.remove_prefix(std::min(text.size(), kViewMark.size() + 1));
    std::string drawn = rows_ > 0 ? fmt::format("\033[{}A", rows_) : "";
    rows_ = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      drawn += fmt::format("\033[2K{}\n", text.substr(at, end - at));
      at = end + 1;
    }
    print(drawn);
  }
  void over() { rows_ = 0; }

 private:
  int rows_ = 0;
};

void record(const Options& options) {
  if (!options.force && fs::exists(options.out))
    throw Error(Error(Fault::graph, "the file exists").at(options.out.string()))
        .hint("--force replaces it");
  plugins::Registry registry;
  Settings settings;
  const std::string extension = fs::path(options.from).extension().string();
  if (extension == ".toml")
    add_graph(settings, options.from, registry, registry.stage(kStage).info());
  else
    settings["address"] = options.from;
  for (const std::string& setting : options.settings) add_setting(settings, setting);
  settings["file"] = options.out.string();
  if (options.rotate > 0.0) settings["rotate"] = fmt::format("{}", options.rotate);
  if (!options.quiet) settings["view"] = on_terminal() ? "0.5 s" : "5 s";
  Picture picture;
  const auto log = [&](run::LocalContext::Level level, const std::string& message) {
    if (!message.starts_with(kViewMark)) {
      picture.over();
      complain((level == run::LocalContext::Level::warning ? "warning: " : "") + message + "\n");
    } else if (on_terminal()) {
      picture.draw(message);
    } else {
      const std::size_t first = message.find('\n') + 1;
      print(message.substr(first, message.find('\n', first) - first + 1));
    }
  };
  run::catch_signals();
  run::LocalContext context(
      {.threads = 1, .arena = 0, .seed = 1, .cancel = &run::stop_requested(), .log = log});
  try {
    const Results results = run::run_single(registry, kStage, settings, {}, context);
    const auto& table = std::get<Table>(results.at(0).value());
    for (std::size_t row = 0; row < table.size(); ++row)
      print(fmt::format("{:<14} {}\n", std::get<std::string>(table.at(row, "figure")),
                        std::get<std::int64_t>(table.at(row, "value"))));
  } catch (const Cancelled&) {
    complain(fmt::format("stopped; the recording is {}\n", options.out.string()));
    throw Exit{run::kInterrupted};
  }
}

}  // namespace

void add_record(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("record", "Raw telegrams of a scanner to a file");
  command->footer(kExamples);
  command->add_option("FROM", options->from, "address of a scanner, or a graph with one (.toml)")
      ->required()
      ->type_name("GRAPH|ADDRESS");
  command->add_option("--out", options->out, "the recording")->required()->type_name("FILE.vrec");
  command->add_option("--set", options->settings, "NAME=VALUE: a parameter of devices.recorder")
      ->type_name("TEXT")
      ->allow_extra_args(false);
  command->add_option("--rotate", options->rotate, "a new part when one is larger [MB]")
      ->check(CLI::PositiveNumber);
  command->add_flag("--force", options->force, "replace a recording that exists");
  command->add_flag("--quiet", options->quiet, "no live view");
  command->callback([options] { record(*options); });
}

}  // namespace velum::app
