// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "testing/bench.hpp"

#include <fmt/format.h>
#include <unistd.h>

namespace velum::test {
namespace {

namespace fs = std::filesystem;

struct Scratch {
  fs::path folder = fs::temp_directory_path() / fmt::format("velum-test-{}", ::getpid());
  Scratch() { fs::create_directories(folder); }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
};

}  // namespace

plugins::Registry& registry() {
  static plugins::Registry registry(plugins::Registry::Trust::open);
  return registry;
}

fs::path scratch_folder() {
  static const Scratch scratch;
  return scratch.folder;
}

std::vector<Setting> settings_of(const StageInfo& info, const std::map<std::string, Setting>& given,
                                 const fs::path& folder) {
  std::vector<Setting> settings;
  for (const Parameter& parameter : info.parameters) {
    const auto at = given.find(parameter.name);
    if (at == given.end() && parameter.required)
      throw Error(Fault::graph,
                  fmt::format("parameter '{}' of {} is required", parameter.name, info.id));
    Setting setting = at == given.end() ? parameter.initial : at->second;
    if (auto* file = std::get_if<std::string>(&setting.value);
        file != nullptr && parameter.type == ParameterType::output_file)
      *file = (folder / *file).string();
    settings.push_back(std::move(setting));
  }
  return settings;
}

}  // namespace velum::test
