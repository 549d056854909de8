// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "graph/check.hpp"

namespace velum::graph {
namespace {

using toml::Kind;

std::vector<std::string> names_of(const std::vector<Port>& ports) {
  std::vector<std::string> names;
  for (const Port& port : ports) names.push_back(port.name);
  return names;
}

std::string type_names(const std::vector<ValueType>& types) {
  std::vector<std::string> names;
  for (const ValueType type : types) names.emplace_back(name_of(type));
  return fmt::format("{}", fmt::join(names, " or "));
}

bool accepts(const Port& input, const Port& output) {
  return std::ranges::any_of(output.types, [&](ValueType type) {
    return std::ranges::find(input.types, type) != input.types.end();
  });
}

const std::vector<Port> kNone;

/// Reads `in` of one node.
class Wiring {
 public:
  Wiring(Check& check, std::size_t index)
      : check_(check),
        checked_(check.nodes[index]),
        draft_(check.document.drafts[index]),
        inputs_(checked_.node.info == nullptr ? kNone : checked_.node.info->inputs) {}

  void read() {
    if (checked_.node.info == nullptr) {
      // Of a stage that is not known, only the names of nodes can be checked.
      key_ = draft_.find("in");
      if (key_ != nullptr) nodes_only(key_->value);
      return;
    }
    checked_.wires.resize(inputs_.size());
    wired_.resize(inputs_.size());
    if (const Key* key = draft_.find("in")) {
      key_ = key;
      whole(key->value);
    }
    for (std::size_t i = 0; i < inputs_.size(); ++i)
      if (inputs_[i].required && wired_[i] == nullptr) missing(inputs_[i]);
    for (const auto& wires : checked_.wires) {
      auto& input = checked_.node.inputs.emplace_back();
      for (const PlacedWire& placed : wires) input.push_back(placed.wire);
    }
  }

 private:
  [[nodiscard]] Reporter report() const { return check_.report(*key_); }
  [[nodiscard]] std::string self() const { return call(checked_.node); }

  void nodes_only(const toml::Node& value) const {
    for (const toml::Node& item : value.items) nodes_only(item);
    for (const toml::Entry& entry : value.entries) nodes_only(entry.value);
    if (!value.is(Kind::string)) return;
    const std::string node = value.text.substr(0, value.text.find('.'));
    if (check_.document.find(node) == nullptr) unknown_node(node, value);
  }

  void whole(const toml::Node& value) {
    if (inputs_.empty()) {
      report().error("E0402", key_->where, fmt::format("{} takes no input", self()));
    } else if (value.is(Kind::table)) {
      for (const toml::Entry& entry : value.entries) by_name(entry);
    } else {
      wired_[0] = &value;
      // A list was perhaps meant for all inputs: that one message is enough.
      if (value.is(Kind::array) && !inputs_[0].many) std::ranges::fill(wired_, &value);
      port(0, value);
    }
  }

  void by_name(const toml::Entry& entry) {
    const auto i = find_input(entry.key);
    if (!i) {
      const auto known = names_of(inputs_);
      report().error("E0402", entry.where, fmt::format("{} has no input '{}'", self(), entry.key),
                     did_you_mean(entry.key, known), known_list(known));
    } else if (wired_[*i] != nullptr) {
      report().error("E0403", entry.where,
                     fmt::format("input '{}' of {} is wired twice", inputs_[*i].name, self()),
                     "keep one of them");
    } else {
      wired_[*i] = &entry.value;
      port(*i, entry.value);
    }
  }

  /// By its name, or by a type that it alone accepts.
  [[nodiscard]] std::optional<std::size_t> find_input(std::string_view name) const {
    std::optional<std::size_t> typed;
    int several = 0;
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      if (inputs_[i].name == name) return i;
      for (const ValueType type : inputs_[i].types) {
        if (name_of(type) != name) continue;
        typed = i;
        ++several;
      }
    }
    return several == 1 ? typed : std::nullopt;
  }

  void port(std::size_t i, const toml::Node& value) {
    if (value.is(Kind::string)) {
      wire(i, value);
    } else if (!value.is(Kind::array)) {
      report().error("E0204", value.where,
                     fmt::format("a wire of {} must be text: \"node\" or \"node.output\"", self()));
    } else if (!inputs_[i].many) {
      report().error("E0409", value.where,
                     fmt::format("input '{}' of {} takes one value", inputs_[i].name, self()),
                     several_hint());
    } else {
      for (const toml::Node& item : value.items) {
        if (item.is(Kind::string)) {
          wire(i, item);
        } else {
          report().error("E0204", item.where, fmt::format("a wire of {} must be text", self()));
        }
      }
      if (value.items.empty() && inputs_[i].required) missing(inputs_[i]);
    }
  }

  [[nodiscard]] std::string several_hint() const {
    if (inputs_.size() < 2) return "take values together with filtering.merge";
    return fmt::format("name the inputs: in = {{ {} = ... }}",
                       fmt::join(names_of(inputs_), " = ..., "));
  }

  void wire(std::size_t i, const toml::Node& value) {
    const std::string node = value.text.substr(0, value.text.find('.'));
    const Draft* source = check_.document.find(node);
    if (source == nullptr) {
      unknown_node(node, value);
      return;
    }
    const auto index = static_cast<std::size_t>(source - check_.document.drafts.data());
    PlacedWire placed{{index, 0}, value.where, key_->file};
    if (const StageInfo* info = check_.nodes[index].node.info) {
      const auto output = find_output(*info, value, node);
      if (!output) return;
      placed.wire.output = *output;
      if (!accepts(inputs_[i], info->outputs[*output])) {
        wrong_type(inputs_[i], check_.nodes[index].node, *output, value);
        return;
      }
    }
    checked_.wires[i].push_back(placed);
  }

  void unknown_node(const std::string& node, const toml::Node& value) const {
    if (!check_.document.complete) return;  // it may be in the file that could not be read
    std::vector<std::string> known;
    if (report().helps())
      for (const Draft& draft : check_.document.drafts)
        if (draft.name != draft_.name) known.push_back(draft.name);
    report().error("E0404", value.where,
                   fmt::format("{} takes from '{}', but there is no such node", self(), node),
                   did_you_mean(node, known), known_list(known));
  }

  [[nodiscard]] std::optional<std::size_t> find_output(const StageInfo& info,
                                                       const toml::Node& value,
                                                       const std::string& node) const {
    const auto known = names_of(info.outputs);
    const std::string called = fmt::format("node '{}' ({})", node, info.id);
    if (known.empty()) {
      report().error("E0405", value.where, fmt::format("{} has no output to take", called));
      return std::nullopt;
    }
    if (value.text.size() == node.size()) return 0;
    const std::string output = value.text.substr(node.size() + 1);
    const auto found = std::ranges::find(known, output);
    if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
    report().error("E0405", value.where, fmt::format("{} has no output '{}'", called, output),
                   did_you_mean(output, known), known_list(known));
    return std::nullopt;
  }

  void wrong_type(const Port& input, const Node& source, std::size_t output,
                  const toml::Node& value) const {
    const auto& outputs = source.info->outputs;
    std::string hint;
    for (const Port& other : outputs)
      if (hint.empty() && accepts(input, other))
        hint = fmt::format("\"{}.{}\" would fit", source.name, other.name);
    report().error("E0406", value.where,
                   fmt::format("input '{}' of {} takes {}; '{}.{}' is {}", input.name, self(),
                               type_names(input.types), source.name, outputs[output].name,
                               type_names(outputs[output].types)),
                   hint);
  }

  void missing(const Port& port) const {
    const bool first = &port == inputs_.data();
    const char* example = port.many ? "[\"NODE\", \"NODE\"]" : "\"NODE\"";
    check_.report(draft_).error(
        "E0401", draft_.where,
        fmt::format("{} lacks its input '{}' ({})", self(), port.name, type_names(port.types)),
        first ? fmt::format("add in = {}", example)
              : fmt::format("add in = {{ {} = {} }}", port.name, example));
  }

  Check& check_;
  Checked& checked_;
  const Draft& draft_;
  const std::vector<Port>& inputs_;
  const Key* key_ = nullptr;
  std::vector<const toml::Node*> wired_;  ///< one an input
};

}  // namespace

void check_wires(Check& check) {
  for (std::size_t i = 0; i < check.nodes.size(); ++i) Wiring(check, i).read();
}

}  // namespace velum::graph
