// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "graph/check.hpp"
#include "graph/settings.hpp"

namespace velum::graph {
namespace {

using toml::Kind;

bool is_bare_key(const std::string& key) {
  return !key.empty() && std::ranges::all_of(key, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
}

std::string key_text(const std::string& key) {
  return is_bare_key(key) ? key : toml::quoted(key);
}

std::string number_text(double x) {
  std::string text = fmt::format("{}", x);
  // Without a point it would be an integer.
  return text.find_first_not_of("-0123456789") == std::string::npos ? text + ".0" : text;
}

std::string line(std::string_view key, const std::string& value) {
  return fmt::format("{} = {}\n", key, value);
}

std::string wire_text(const Check& check, const Wire& wire) {
  const Node& source = check.nodes[wire.node].node;
  return toml::quoted(source.name + "." + source.info->outputs[wire.output].name);
}

std::string wires_text(const Check& check, const Checked& checked) {
  std::vector<std::string> inputs;
  for (std::size_t i = 0; i < checked.node.inputs.size(); ++i) {
    const Port& port = checked.node.info->inputs[i];
    std::vector<std::string> wires;
    for (const Wire& wire : checked.node.inputs[i]) wires.push_back(wire_text(check, wire));
    if (wires.empty()) continue;
    inputs.push_back(port.many ? fmt::format("{} = [{}]", port.name, fmt::join(wires, ", "))
                               : fmt::format("{} = {}", port.name, wires.front()));
  }
  return inputs.empty() ? "" : line("in", fmt::format("{{ {} }}", fmt::join(inputs, ", ")));
}

std::string limits_text(const Limits& limits) {
  std::vector<std::string> entries;
  if (limits.seconds) entries.push_back(fmt::format("time = \"{} s\"", *limits.seconds));
  if (limits.bytes) entries.push_back(fmt::format("memory = \"{} B\"", *limits.bytes));
  return entries.empty() ? "" : line("limits", fmt::format("{{ {} }}", fmt::join(entries, ", ")));
}

std::string node_text(const Check& check, const Checked& checked) {
  const Node& node = checked.node;
  std::string text = fmt::format("\n[node.{}]\n", node.name) + line("use", toml::quoted(node.use));
  if (!node.title.empty()) text += line("title", toml::quoted(node.title));
  text += wires_text(check, checked);
  if (node.isolate != node.info->isolated) text += line("isolate", node.isolate ? "true" : "false");
  if (node.allow_empty) text += line("allow_empty", "true");
  if (!node.cache) text += line("cache", "false");
  if (node.seed) text += line("seed", fmt::format("{}", *node.seed));
  text += limits_text(node.limits);
  for (std::size_t i = 0; i < node.settings.size(); ++i) {
    const Parameter& parameter = node.info->parameters[i];
    // A default is left to the stage, but for the unit that came from the file.
    const bool said = checked.given[i] != nullptr || parameter.type == ParameterType::length_unit;
    if (said && node.settings[i].is_set())
      text += line(parameter.name, to_toml(parameter, node.settings[i]));
  }
  return text;
}

std::string study_text(const toml::Node& study) {
  std::string text = "\n[study]\n";
  for (const toml::Entry& entry : study.entries)
    if (entry.key != "slurm")  // where it runs is no part of what is run
      text += line(key_text(entry.key), value_text(entry.value));
  return text;
}

}  // namespace

std::string value_text(const toml::Node& value) {
  switch (value.kind) {
    case Kind::string:
      return toml::quoted(value.text);
    case Kind::integer:
      return fmt::format("{}", value.integer);
    case Kind::number:
      return number_text(value.number);
    case Kind::boolean:
      return value.boolean ? "true" : "false";
    case Kind::array: {
      std::vector<std::string> items;
      for (const toml::Node& item : value.items) items.push_back(value_text(item));
      return fmt::format("[{}]", fmt::join(items, ", "));
    }
    case Kind::table: {
      std::vector<std::string> entries;
      for (const toml::Entry& entry : value.entries)
        entries.push_back(key_text(entry.key) + " = " + value_text(entry.value));
      return entries.empty() ? "{}" : fmt::format("{{ {} }}", fmt::join(entries, ", "));
    }
    default:
      return value.text;
  }
}

std::string resolved_text(const Check& check) {
  std::string text = "format = 1\n";
  if (!check.document.title.empty()) text += line("title", toml::quoted(check.document.title));
  if (!check.document.units.empty()) text += line("units", toml::quoted(check.document.units));
  for (const Checked& checked : check.nodes) text += node_text(check, checked);
  if (check.document.study != nullptr) text += study_text(check.document.study->value);
  return text;
}

}  // namespace velum::graph
