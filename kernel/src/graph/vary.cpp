// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "graph/document.hpp"

namespace velum::graph {
namespace {

using toml::Kind;
using Names = std::set<std::string, std::less<>>;

/// Wires to helpers of `node` get the names that the helpers have in the graph.
void rename_wires(toml::Node& in, const std::string& node, const Names& helpers) {
  if (in.is(Kind::string)) {
    if (helpers.contains(in.text.substr(0, in.text.find('.')))) in.text = node + "-" + in.text;
  } else if (in.is(Kind::array)) {
    for (toml::Node& item : in.items) rename_wires(item, node, helpers);
  } else if (in.is(Kind::table)) {
    for (toml::Entry& entry : in.entries) rename_wires(entry.value, node, helpers);
  }
}

class Variant {
 public:
  Variant(Document& document, Diagnostics& diagnostics)
      : document_(document),
        file_(document.files.front()),
        report_(diagnostics, document.files.front().source) {}

  void replace(const Variation::Alternative& alternative) {
    Draft* draft = find(alternative.node, alternative.keys.where);
    if (draft == nullptr) return;
    const toml::Entry* with = alternative.keys.find("with");
    Names helpers;
    if (with != nullptr)
      for (const toml::Entry& helper : with->value.entries) helpers.insert(helper.key);
    std::vector<Key> keys = keys_of(alternative.keys, alternative.node, helpers);
    const auto is_in = [](const Key& key) { return key.name == "in"; };
    if (const Key* in = draft->find("in"); in != nullptr && std::ranges::none_of(keys, is_in))
      keys.push_back(*in);
    draft->keys = std::move(keys);
    if (with == nullptr) return;
    for (const toml::Entry& helper : with->value.entries) add(helper, alternative.node, helpers);
  }

  void set(const Variation::Value& value) {
    Draft* draft = find(value.node, value.value.where);
    if (draft == nullptr) return;
    Key key{value.parameter, value.value.where, value.value, &file_};
    const auto old = std::ranges::find(draft->keys, value.parameter, &Key::name);
    if (old == draft->keys.end())
      draft->keys.push_back(std::move(key));
    else
      *old = std::move(key);
  }

 private:
  Draft* find(const std::string& name, toml::Region where) {
    const auto found = std::ranges::find(document_.drafts, name, &Draft::name);
    if (found != document_.drafts.end()) return &*found;
    report_.error("E0404", where,
                  fmt::format("the study names '{}', but there is no such node", name));
    return nullptr;
  }

  std::vector<Key> keys_of(const toml::Node& table, const std::string& node,
                           const Names& helpers) const {
    std::vector<Key> keys;
    for (const toml::Entry& entry : table.entries) {
      if (entry.key == "with") continue;
      keys.push_back({entry.key, entry.where, entry.value, &file_});
      if (entry.key == "in") rename_wires(keys.back().value, node, helpers);
    }
    return keys;
  }

  void add(const toml::Entry& helper, const std::string& node, const Names& helpers) {
    const std::string name = node + "-" + helper.key;
    if (std::ranges::find(document_.drafts, name, &Draft::name) != document_.drafts.end()) {
      report_.error("E0302", helper.where,
                    fmt::format("the helper '{}' would be node '{}', which is there already",
                                helper.key, name),
                    "give it another name");
      return;
    }
    document_.drafts.push_back({name, helper.where, &file_, keys_of(helper.value, node, helpers)});
  }

  Document& document_;
  const File& file_;
  Reporter report_;
};

}  // namespace

void vary(Document& document, const Variation& variation, Diagnostics& diagnostics) {
  Variant variant(document, diagnostics);
  for (const auto& alternative : variation.alternatives) variant.replace(alternative);
  for (const auto& value : variation.values) variant.set(value);
  std::ranges::sort(document.drafts, {}, &Draft::name);
  document.study = nullptr;
}

}  // namespace velum::graph
