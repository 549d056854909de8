// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>

#include "graph/check.hpp"
#include "graph/settings.hpp"
#include "graph/units.hpp"

namespace velum::graph {
namespace {

using toml::Kind;

Setting said(const Key& key, ParameterType type, const Reporter& report, Range range = anything()) {
  Parameter parameter;
  parameter.name = key.name;
  parameter.type = type;
  parameter.range = range;
  return parse_setting(parameter, key.value, {}, report);
}

void flag(const Draft& draft, const char* name, const Check& check, bool& to) {
  const Key* key = draft.find(name);
  if (key == nullptr) return;
  const Setting setting = said(*key, ParameterType::boolean, check.report(*key));
  if (setting.is_set()) to = std::get<bool>(setting.value);
}

void memory(const toml::Entry& entry, const Reporter& report, Limits& limits) {
  const auto amount =
      entry.value.is(Kind::string) ? parse_amount(entry.value.text) : std::optional<Amount>{};
  if (!amount) {
    report.error("E0204", entry.value.where, "'limits.memory' must be text such as \"2 GB\"");
    return;
  }
  const auto bytes = to_bytes(*amount);
  if (!bytes) {
    report.error("E0205", entry.value.where,
                 fmt::format("'limits.memory': '{}' is no unit of memory", amount->unit),
                 did_you_mean(amount->unit, byte_units()), known_list(byte_units()));
  } else if (*bytes < 1 || *bytes > 1e18) {
    report.error("E0206", entry.value.where,
                 fmt::format("'limits.memory' is \"{}\"; it must be above 0", entry.value.text));
  } else {
    limits.bytes = static_cast<std::uint64_t>(*bytes);
  }
}

void limits(const Draft& draft, const Check& check, Node& node) {
  const Key* key = draft.find("limits");
  if (key == nullptr) return;
  const Reporter report = check.report(*key);
  if (!key->value.is(Kind::table)) {
    report.error("E0204", key->value.where, "'limits' must be a table",
                 "write limits = { time = \"60 s\", memory = \"2 GB\" }");
    return;
  }
  for (const toml::Entry& entry : key->value.entries) {
    if (entry.key == "time") {
      const Key time{"limits.time", entry.where, entry.value, key->file};
      const Setting setting = said(time, ParameterType::duration, report, above(0));
      if (setting.is_set()) node.limits.seconds = std::get<double>(setting.value);
    } else if (entry.key == "memory") {
      memory(entry, report, node.limits);
    } else {
      const std::vector<std::string> known = {"time", "memory"};
      report.error("E0202", entry.where, fmt::format("unknown key '{}' of 'limits'", entry.key),
                   did_you_mean(entry.key, known), known_list(known));
    }
  }
  if (!node.isolate)
    report.error("E0212", key->where, "limits hold for isolated nodes only", "add isolate = true");
}

void node_settings(const Draft& draft, const Check& check, Node& node) {
  node.isolate = node.info != nullptr && node.info->isolated;
  flag(draft, "isolate", check, node.isolate);
  flag(draft, "allow_empty", check, node.allow_empty);
  flag(draft, "cache", check, node.cache);
  limits(draft, check, node);
  if (const Key* key = draft.find("title")) {
    const Setting title = said(*key, ParameterType::text, check.report(*key));
    if (title.is_set()) node.title = std::get<std::string>(title.value);
  }
  if (const Key* key = draft.find("seed")) {
    if (key->value.is(Kind::integer) && key->value.integer >= 0)
      node.seed = static_cast<std::uint64_t>(key->value.integer);
    else
      said(*key, ParameterType::integer, check.report(*key), at_least(0));
  }
}

/// The nearest id; a name without its kind is looked for among all kinds.
std::string suggest(const std::string& use, const std::vector<std::string>& ids) {
  for (const std::string& id : ids)
    if (id.ends_with("." + use)) return fmt::format("did you mean '{}'?", id);
  return did_you_mean(use, ids);
}

/// Other stages of the same kind, or else the kinds.
std::string known_stages(const std::string& use, const std::vector<std::string>& ids) {
  const std::string kind = use.substr(0, use.find('.') + 1);
  std::vector<std::string> same;
  std::vector<std::string> kinds;
  for (const std::string& id : ids) {
    if (!kind.empty() && id.starts_with(kind)) same.push_back(id);
    std::string other = id.substr(0, id.find('.')) + ".*";
    if (kinds.empty() || kinds.back() != other) kinds.push_back(std::move(other));
  }
  return known_list(same.empty() ? kinds : same);
}

void find_stage(const Key& key, const Check& check, Node& node) {
  const Reporter report = check.report(key);
  const Setting use = said(key, ParameterType::text, report);
  if (!use.is_set()) return;
  node.use = std::get<std::string>(use.value);
  if (node.use.starts_with("graph:")) {
    report.error("E0306", key.value.where, "graphs within graphs are reserved for a later version",
                 "merge the nodes of the other file: include = \"other.toml\"");
    return;
  }
  node.info = check.catalog.find(node.use);
  if (node.info != nullptr) return;
  if (const std::string reason = check.catalog.why_not(node.use); !reason.empty()) {
    report
        .error("E0305", key.value.where,
               fmt::format("the plugin of '{}' cannot be loaded: {}", node.use, reason))
        .fault = Fault::plugin;
    return;
  }
  const auto ids = report.helps() ? check.catalog.ids() : std::vector<std::string>{};
  std::string known = known_stages(node.use, ids);
  report.error(
      "E0304", key.value.where, fmt::format("unknown stage '{}' in node '{}'", node.use, node.name),
      suggest(node.use, ids),
      known.empty() && report.helps() ? "no plugins found; VELUM_PLUGIN_PATH tells where they are"
                                      : known);
}

}  // namespace

std::string call(const Node& node) {
  return fmt::format("node '{}' ({})", node.name, node.use);
}

void check_stages(Check& check) {
  for (const Draft& draft : check.document.drafts) {
    Node& node = check.nodes.emplace_back().node;
    node.name = draft.name;
    node.file = draft.file->source.name();
    node.where = draft.where;
    if (const Key* key = draft.find("use")) {
      find_stage(*key, check, node);
    } else {
      check.report(draft).error("E0303", draft.where,
                                fmt::format("node '{}' says no stage", draft.name),
                                "add use = \"KIND.NAME\"; `velum list` shows them");
    }
    node_settings(draft, check, node);
  }
}

}  // namespace velum::graph
