// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "run/single.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "graph/settings.hpp"
#include "plugins/call.hpp"
#include "run/isolate.hpp"

namespace velum::run {
namespace {

// A file's name is taken as it is: it may look like TOML.
Setting parse(const Parameter& parameter, const std::string& text) {
  const bool file =
      parameter.type == ParameterType::input_file || parameter.type == ParameterType::output_file;
  if (!file) return graph::parse_setting_text(parameter, text);
  return {std::filesystem::absolute(text).lexically_normal().string()};
}

// A folder of this process among the system's temporary ones.
struct Scratch {
  Scratch() : folder((std::filesystem::temp_directory_path() / "velum-XXXXXX").string()) {
    if (::mkdtemp(folder.data()) == nullptr)
      throw Error(Fault::output,
                  fmt::format("no folder for temporary files: {}", std::strerror(errno)))
          .at(folder);
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  std::string folder;
};

}  // namespace

Results run_single(plugins::Registry& registry, const std::string& stage,
                   const std::map<std::string, std::string>& settings, std::vector<Wired> inputs,
                   LocalContext& context) {
  const StageType& type = registry.stage(stage);
  std::vector<Setting> values;
  for (const Parameter& parameter : type.info().parameters) {
    const auto given = settings.find(parameter.name);
    values.push_back(given == settings.end() ? parameter.initial : parse(parameter, given->second));
  }
  for (const auto& [name, text] : settings) {
    const auto& known = type.info().parameters;
    if (std::none_of(known.begin(), known.end(),
                     [&name = name](const auto& p) { return p.name == name; }))
      throw Error(Fault::graph, fmt::format("{} has no parameter '{}'", stage, name));
  }
  const plugins::Call call = plugins::prepare(type.info(), std::move(values), std::move(inputs));
  if (!type.info().isolated) return plugins::invoke(type, call, context);
  const Scratch scratch;
  return run_isolated({.id = stage,
                       .info = &type.info(),
                       .plugin = registry.file(stage),
                       .limits = {},
                       .seed = context.seed(),
                       .scratch = scratch.folder},
                      call, context)
      .results;
}

}  // namespace velum::run
