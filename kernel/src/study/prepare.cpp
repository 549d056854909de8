// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/prepare.hpp"

#include <algorithm>
#include <span>

#include "run/run.hpp"
#include "velum/error.hpp"
#include "velum/files.hpp"

namespace velum::study {
namespace {

/// The stages that some variant uses, as far as they are there: opening them here saves every cell
/// from doing it.
std::set<std::string> stages_of(const graph::Graph& graph, const graph::Study& study,
                                plugins::Registry& registry) {
  std::set<std::string> stages;
  for (const graph::Node& node : graph.nodes) stages.insert(node.use);
  const auto add = [&](const graph::toml::Node& keys) {
    if (const auto* use = keys.find("use")) stages.insert(use->value.text);
  };
  for (const graph::Axis& axis : study.axes)
    for (const graph::Choice& choice : axis.choices)
      for (const auto& alternative : choice.variation.alternatives) {
        add(alternative.keys);
        if (const auto* with = alternative.keys.find("with"))
          for (const auto& helper : with->value.entries) add(helper.value);
      }
  std::erase_if(stages, [&](const std::string& id) { return registry.find(id) == nullptr; });
  return stages;
}

/// Of what the cells do: the graph, its study, the programs.
std::string hash_of_work(const graph::Graph& graph, const graph::Study& study,
                         const std::set<std::string>& stages, plugins::Registry& registry) {
  std::string all = std::string(kVersion) + "\n" + graph.resolved;
  for (const std::string& id : stages) all += id + " " + registry.file_hash(id) + "\n";
  for (const graph::Axis& axis : study.axes)
    for (const graph::Choice& choice : axis.choices) all += axis.name + "=" + choice.label + "\n";
  return hash_of(std::as_bytes(std::span(all)));
}

/// Of the files that the study names.
class Files {
 public:
  explicit Files(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void add(const std::string& name) {
    const std::filesystem::path file = folder_ / name;
    std::error_code none;
    if (std::filesystem::is_regular_file(file, none) && seen_.insert(name).second)
      all_ += name + " " + hash_of(FileContent(file).bytes()) + "\n";
  }
  /// Any text of an alternative or of its helpers may be the name of one.
  void add(const graph::toml::Node& value) {
    if (value.is(graph::toml::Kind::string)) add(value.text);
    for (const graph::toml::Node& item : value.items) add(item);
    for (const graph::toml::Entry& entry : value.entries) add(entry.value);
  }
  [[nodiscard]] std::string hash() const { return hash_of(std::as_bytes(std::span(all_))); }

 private:
  std::filesystem::path folder_;
  std::set<std::string> seen_;
  std::string all_;
};

std::string hash_of_files(const graph::Graph& graph, const graph::Study& study) {
  Files files(graph.path.parent_path());
  for (const graph::Node& node : graph.nodes)
    for (std::size_t i = 0; i < node.settings.size(); ++i)
      if (node.info->parameters[i].type == ParameterType::input_file)
        if (const auto* name = std::get_if<std::string>(&node.settings[i].value)) files.add(*name);
  for (const graph::Axis& axis : study.axes)
    for (const graph::Choice& choice : axis.choices) {
      for (const auto& value : choice.variation.values) files.add(value.value);
      for (const auto& alternative : choice.variation.alternatives) files.add(alternative.keys);
    }
  return files.hash();
}

}  // namespace

std::set<std::string> sources_of(const graph::Graph& graph) {
  std::set<std::string> sources;
  for (const graph::Node& node : graph.nodes)
    if (std::ranges::all_of(node.inputs, [](const auto& wires) { return wires.empty(); }))
      sources.insert(node.name);
  return sources;
}

void require_effect(const graph::Study& study, const std::vector<std::string>& overrides) {
  const auto refuse = [](const std::string& setting, const std::string& what) {
    throw Error(Fault::graph, "the study varies '" + what + "': the value would be lost")
        .at("--set " + setting)
        .hint("leave it out, or take the axis away");
  };
  for (const std::string& setting : overrides) {
    const std::string name = setting.substr(0, setting.find('='));
    const std::string node = name.substr(0, name.find('.'));
    for (const graph::Axis& axis : study.axes)
      for (const graph::Choice& choice : axis.choices) {
        for (const auto& value : choice.variation.values)
          if (value.node + "." + value.parameter == name) refuse(setting, name);
        // An alternative keeps its node's `in` and nothing else.
        for (const auto& alternative : choice.variation.alternatives)
          if (alternative.node == node && name != node + ".in") refuse(setting, node);
      }
  }
}

Prepared prepare(const graph::Graph& graph, plugins::Registry& registry, bool with_files) {
  if (!graph.study)
    throw Error(Fault::graph, "the graph has no study")
        .at(graph.path.string())
        .hint("add [study] with measure = [...] and [[study.vary]]");
  Plan plan = make_plan(*graph.study);
  const std::set<std::string> stages = stages_of(graph, plan.study, registry);
  std::string key = hash_of_work(graph, plan.study, stages, registry) + ".";
  if (with_files) key += hash_of_files(graph, plan.study);
  return {std::move(plan), {run::graph_name(graph.path), std::move(key)}, sources_of(graph)};
}

}  // namespace velum::study
