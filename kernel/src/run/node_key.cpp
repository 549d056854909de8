// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// What a node's results depend on.
#include <filesystem>

#include "files/hasher.hpp"
#include "run/linked.hpp"
#include "run/machine.hpp"
#include "run/node_runner.hpp"
#include "run/setting_json.hpp"

namespace velum::run {
namespace {

namespace fs = std::filesystem;

bool may_be_cached(const graph::Node& node) {
  // Devices see the world, and their scenes may name further files.
  const bool device = node.use.starts_with("devices.");
  bool writes = false;
  for (std::size_t i = 0; i < node.settings.size(); ++i)
    if (node.info->parameters[i].type == ParameterType::output_file && node.settings[i].is_set())
      writes = true;
  return node.cache && node.info->cacheable && node.info->determinism != Determinism::none &&
         !device && !writes;
}

// Calls use(path) for each file that is named in the setting, in order.
template <class Use>
void each_input_file(const Parameter& parameter, const Setting& setting, const Use& use) {
  if (!setting.is_set()) return;
  if (parameter.type == ParameterType::rows) {
    for (const Setting& row : std::get<Setting::List>(setting.value))
      for (std::size_t i = 0; i < parameter.fields.size(); ++i)
        each_input_file(parameter.fields[i], std::get<Setting::List>(row.value).at(i), use);
  } else if (parameter.type == ParameterType::input_file) {
    if (const auto* list = std::get_if<Setting::List>(&setting.value))
      for (const Setting& entry : *list) use(std::get<std::string>(entry.value));
    else
      use(std::get<std::string>(setting.value));
  }
}

}  // namespace

Json NodeRunner::describe_inputs(const State& state) {
  Json in = Json::object();
  const graph::Node& node = *state.node;
  const std::lock_guard lock(mutex_);
  const auto describe = [&](const graph::Wire& wire) {
    const State& source = states_[wire.node];
    const std::string& output = source.node->info->outputs[wire.output].name;
    Json json = {{"from", source.node->name + "." + output}};
    const Json& summary = source.record.out.at(output);
    if (summary.is_null()) return json;
    for (const char* key : {"type", "hash", "points", "triangles", "rows"})
      if (summary.contains(key)) json[key] = summary.at(key);
    return json;
  };
  for (std::size_t port = 0; port < node.inputs.size(); ++port) {
    const auto& wires = node.inputs[port];
    if (wires.empty()) continue;
    Json& json = in[node.info->inputs[port].name];
    if (!node.info->inputs[port].many) {
      json = describe(wires.front());
      continue;
    }
    json = Json::array();
    for (const graph::Wire& wire : wires) json.push_back(describe(wire));
  }
  return in;
}

// The record of a file that a node reads, which is hashed once a run.
FileRecord NodeRunner::input_file(const std::string& path) {
  const std::lock_guard reading(reading_);
  {
    const std::lock_guard lock(mutex_);
    const auto known = inputs_.find(path);
    if (known != inputs_.end()) return known->second;
  }
  FileRecord record = describe_file(path);
  const std::lock_guard lock(mutex_);
  return inputs_.emplace(path, std::move(record)).first->second;
}

// Inputs count by their content, not by how they came about: where an earlier stage with other
// parameters gives the same bytes, what follows need not run again. Relative lengths count as they
// are written, since what they come to follows from the inputs.
std::string NodeRunner::make_key(const State& state) {
  const graph::Node& node = *state.node;
  std::vector<FileRecord> files;
  for (std::size_t i = 0; i < node.settings.size(); ++i)
    each_input_file(node.info->parameters[i], node.settings[i],
                    [&](const std::string& path) { files.push_back(input_file(path)); });
  if (options_.cache == nullptr || !may_be_cached(node)) return "";

  files::Hasher hasher;
  const auto add = [&](std::string_view text) { hasher.add(text); };
  add("result 1");
  add(kVersion);
  add(kernel_hash());
  add(instruction_set());
  add(node.use);
  add(node.info->version);
  add(state.record.plugin_hash);
  add(linked_libraries(registry_.file(node.use)));
  hasher.add(node.allow_empty);
  Json settings = to_json(node.info->parameters, node.settings);
  for (const FileRecord& file : files) {
    // The name counts, since readers choose the format by it; the folder does not.
    add(fs::path(file.path).filename().string());
    add(file.hash);
  }
  for (const Parameter& parameter : node.info->parameters)
    if (parameter.type == ParameterType::input_file) settings.erase(parameter.name);
  add(dump(settings));
  for (std::size_t port = 0; port < node.inputs.size(); ++port) {
    hasher.add(std::uint64_t{node.inputs[port].size()});
    for (const graph::Wire& wire : node.inputs[port]) {
      const State& source = states_[wire.node];
      const std::lock_guard lock(mutex_);
      const Json& summary = source.record.out.at(source.node->info->outputs[wire.output].name);
      add(summary.is_null() ? "" : summary.at("hash").get<std::string>());
    }
  }
  if (node.info->determinism == Determinism::seeded)
    hasher.add(node_seed(node.seed.value_or(options_.seed), node.use, node.name));
  return hasher.hex();
}

}  // namespace velum::run
