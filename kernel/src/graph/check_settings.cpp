// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>

#include "graph/check.hpp"
#include "graph/settings.hpp"

namespace velum::graph {
namespace {

constexpr const char* kUnknownParameter = "E0203";

/// Index of the parameter called `name`, now or formerly; that of the end when there is none.
std::size_t find_parameter(const StageInfo& info, std::string_view name) {
  const auto now = std::ranges::find(info.parameters, name, &Parameter::name);
  const auto found = now != info.parameters.end()
                         ? now
                         : std::ranges::find_if(info.parameters, [&](const Parameter& p) {
                             return std::ranges::find(p.old_names, name) != p.old_names.end();
                           });
  return static_cast<std::size_t>(found - info.parameters.begin());
}

void unknown_parameter(const Check& check, const Checked& checked, const Key& key) {
  std::vector<std::string> known;
  for (const Parameter& parameter : checked.node.info->parameters) known.push_back(parameter.name);
  std::vector<std::string> words = known;
  words.insert(words.end(), node_keys().begin(), node_keys().end());
  std::string hint = did_you_mean(key.name, words);
  for (const Port& port : checked.node.info->inputs)
    if (port.name == key.name) hint = fmt::format("write in = {{ {} = ... }}", key.name);
  check.report(key).error(kUnknownParameter, key.where,
                          fmt::format("unknown parameter '{}' in {}", key.name, call(checked.node)),
                          hint, known.empty() ? "the stage has no parameters" : known_list(known));
}

void read_setting(const Check& check, Checked& checked, const Key& key) {
  const auto& parameters = checked.node.info->parameters;
  const std::size_t i = find_parameter(*checked.node.info, key.name);
  if (i == parameters.size()) {
    unknown_parameter(check, checked, key);
    return;
  }
  const Reporter report = check.report(key).about("of " + call(checked.node));
  // An override may use another of the names than the file does.
  if (checked.given[i] != nullptr && checked.given[i]->file == key.file) {
    report.error("E0209", key.where,
                 fmt::format("'{}' and '{}' are the same parameter {}", checked.given[i]->name,
                             key.name, report.subject()),
                 fmt::format("keep '{}'", parameters[i].name));
    return;
  }
  checked.given[i] = &key;
  Parameter named = parameters[i];
  named.name = key.name;
  checked.node.settings[i] = parse_setting(named, key.value, key.file->units, report);
}

void read_settings(const Check& check, Checked& checked, const Draft& draft) {
  for (const Key& key : draft.keys)
    if (std::ranges::find(node_keys(), key.name) == node_keys().end())
      read_setting(check, checked, key);
}

/// What must be given and is not, and what is the file's when it is not given.
void complete(const Check& check, Checked& checked, const Draft& draft) {
  const auto& parameters = checked.node.info->parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (checked.given[i] != nullptr) continue;
    const Parameter& parameter = parameters[i];
    if (parameter.required)
      check.report(draft).error(
          "E0207", draft.where,
          fmt::format("{} lacks the parameter '{}': {}", call(checked.node), parameter.name,
                      parameter.doc),
          fmt::format("add {} = {}", parameter.name, describe_type(parameter)));
    if (parameter.type == ParameterType::length_unit && draft.file->units.length)
      checked.node.settings[i] = {draft.file->units.length->name};
  }
}

/// What the stage itself says of settings that are right one by one.
void ask_stage(const Check& check, const Checked& checked, const Draft& draft) {
  const StageInfo& info = *checked.node.info;
  if (!info.check) return;
  const auto report = [&](const Error& error) {
    const std::size_t i = find_parameter(info, error.where());
    const Key* key = i < checked.given.size() ? checked.given[i] : nullptr;
    const Reporter reporter = key == nullptr ? check.report(draft) : check.report(*key);
    reporter.error("E0211", key == nullptr ? draft.where : key->where,
                   fmt::format("{}: {}", call(checked.node), error.what()), error.hint());
  };
  try {
    info.check(checked.node.settings);
  } catch (const Error& error) {
    report(error);
  } catch (const std::exception& error) {
    report(Error(Fault::stage, error.what()));
  }
}

}  // namespace

void check_settings(Check& check) {
  for (std::size_t n = 0; n < check.nodes.size(); ++n) {
    Checked& checked = check.nodes[n];
    if (checked.node.info == nullptr) continue;
    const Draft& draft = check.document.drafts[n];
    for (const Parameter& parameter : checked.node.info->parameters)
      checked.node.settings.push_back(parameter.initial);
    checked.given.resize(checked.node.settings.size());
    const std::size_t mistakes = check.diagnostics.size();
    read_settings(check, checked, draft);
    complete(check, checked, draft);
    checked.all_read = std::all_of(
        check.diagnostics.begin() + static_cast<std::ptrdiff_t>(mistakes), check.diagnostics.end(),
        [](const Diagnostic& one) { return one.code == kUnknownParameter; });
  }
}

void check_together(Check& check) {
  for (std::size_t n = 0; n < check.nodes.size(); ++n)
    if (check.nodes[n].node.info != nullptr && check.nodes[n].all_read)
      ask_stage(check, check.nodes[n], check.document.drafts[n]);
}

}  // namespace velum::graph
