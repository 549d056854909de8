// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "graph/check.hpp"
#include "graph/settings.hpp"

namespace velum::graph {
namespace {

/// The columns that an output may have; nothing when it could be any.
using Columns = std::optional<std::set<std::string>>;

bool applies(const ColumnRule& rule, const Node& node) {
  if (rule.parameter.empty()) return true;
  const auto& parameters = node.info->parameters;
  const auto found = std::ranges::find(parameters, rule.parameter, &Parameter::name);
  if (found == parameters.end()) return false;
  const auto& setting = node.settings[static_cast<std::size_t>(found - parameters.begin())];
  if (const auto* text = std::get_if<std::string>(&setting.value)) return *text == rule.value;
  return to_toml(*found, setting) == rule.value;
}

/// Only clouds are followed from node to node, alone or as part of clusters.
bool is_followed(const Port& output) {
  return output.types.front() == ValueType::cloud || output.types.front() == ValueType::clusters;
}

/// Follows columns along the wires.
class Needs {
 public:
  explicit Needs(Check& check) : check_(check), columns_(check.nodes.size()) {}

  void node(std::size_t index) {
    const Checked& checked = check_.nodes[index];
    if (checked.node.info == nullptr) return;
    const StageInfo& info = *checked.node.info;
    for (std::size_t i = 0; i < info.inputs.size(); ++i)
      for (const ColumnRule& rule : info.inputs[i].columns)
        if (applies(rule, checked.node)) need(checked, i, rule.column);
    for (const Port& output : info.outputs) columns_[index].push_back(made(checked, output));
  }

 private:
  void need(const Checked& checked, std::size_t input, const std::string& column) {
    for (const PlacedWire& wire : checked.wires[input]) {
      const Columns& columns = of(wire);
      if (!columns || columns->contains(column)) continue;
      const Node& source = check_.nodes[wire.wire.node].node;
      Reporter(check_.diagnostics, wire.file->source)
          .error("E0407", wire.where,
                 fmt::format("input '{}' of {} needs {}; '{}.{}' has none",
                             checked.node.info->inputs[input].name, call(checked.node), column,
                             source.name, source.info->outputs[wire.wire.output].name),
                 advice(column));
    }
  }

  [[nodiscard]] const Columns& of(const PlacedWire& wire) const {
    static const Columns kAny;
    const auto& outputs = columns_[wire.wire.node];
    return wire.wire.output < outputs.size() ? outputs[wire.wire.output] : kAny;
  }

  [[nodiscard]] Columns made(const Checked& checked, const Port& output) const {
    if (!is_followed(output)) return std::nullopt;
    Columns columns = kept(checked, output);
    if (!columns) return std::nullopt;
    for (const ColumnRule& rule : output.columns)
      if (applies(rule, checked.node)) columns->insert(rule.column);
    return columns;
  }

  [[nodiscard]] Columns kept(const Checked& checked, const Port& output) const {
    const StageInfo& info = *checked.node.info;
    // A file may hold any column; a device makes those that it declares, if it declares any.
    if (info.inputs.empty()) {
      if (info.id.starts_with("io.") || output.columns.empty()) return std::nullopt;
      return std::set<std::string>();
    }
    if (!info.keeps_columns) return std::set<std::string>();
    if (checked.wires.front().empty()) return std::nullopt;
    std::set<std::string> all;
    for (const PlacedWire& wire : checked.wires.front()) {
      const Columns& columns = of(wire);
      if (!columns) return std::nullopt;
      all.insert(columns->begin(), columns->end());
    }
    return all;
  }

  /// The first of the features that adds the column; that of the same name before all others.
  std::string advice(const std::string& column) {
    const auto [known, fresh] = advice_.try_emplace(column);
    if (!fresh) return known->second;
    std::vector<std::string> ids = check_.catalog.ids();
    std::erase_if(ids, [](const std::string& id) { return !id.starts_with("features."); });
    std::stable_partition(ids.begin(), ids.end(),
                          [&](const std::string& id) { return id == "features." + column; });
    for (const std::string& id : ids) {
      const StageInfo* info = check_.catalog.find(id);
      if (info == nullptr || !adds(*info, column)) continue;
      known->second = fmt::format("put a node with use = \"{}\" before it", id);
      break;
    }
    return known->second;
  }

  static bool adds(const StageInfo& info, const std::string& column) {
    return std::ranges::any_of(info.outputs, [&](const Port& output) {
      return std::ranges::find(output.columns, column, &ColumnRule::column) != output.columns.end();
    });
  }

  Check& check_;
  std::vector<std::vector<Columns>> columns_;  ///< one a node and output
  std::map<std::string, std::string> advice_;  ///< by column
};

}  // namespace

void check_needs(Check& check, const std::vector<std::size_t>& order) {
  Needs needs(check);
  for (const std::size_t index : order) needs.node(index);
}

}  // namespace velum::graph
