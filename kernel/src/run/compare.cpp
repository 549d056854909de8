// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "run/compare.hpp"

#include <fmt/format.h>

namespace velum::run {
namespace {

const Json* find(const Json& list, const char* key, const Json& value) {
  for (const Json& entry : list)
    if (entry.at(key) == value) return &entry;
  return nullptr;
}

bool well(const Json& status) {
  return status == "ok" || status == "cached";
}

std::string text(const Json& json) {
  return json.is_string() ? json.get<std::string>() : dump(json);
}

class Comparison {
 public:
  void files(const char* what, const Json& before, const Json& after) {
    for (const Json& file : before) {
      const std::string path = text(file.at("path"));
      const Json* other = find(after, "path", file.at("path"));
      if (other == nullptr) {
        add(fmt::format("{} '{}' is missing now", what, path));
      } else if (other->at("hash") != file.at("hash")) {
        add(fmt::format("{} '{}': hash {} before, {} now", what, path, text(file.at("hash")),
                        text(other->at("hash"))));
      }
    }
  }

  void node(const Json& before, const Json& after) {
    const std::string name = text(before.at("name"));
    if (well(before.at("status")) != well(after.at("status"))) {
      add(fmt::format("node '{}': {} before, {} now", name, text(before.at("status")),
                      text(after.at("status"))));
      return;
    }
    for (const auto& [port, summary] : before.at("out").items()) {
      const Json hash = summary.is_null() ? Json("nothing") : summary.at("hash");
      const auto found = after.at("out").find(port);
      const bool made = found != after.at("out").end() && !found->is_null();
      const Json other = made ? found->at("hash") : Json("nothing");
      if (hash != other)
        add(fmt::format("node '{}', output '{}': hash {} before, {} now{}", name, port, text(hash),
                        text(other), reason(before, after)));
    }
  }

  std::vector<std::string> differences;

 private:
  void add(std::string line) { differences.push_back(std::move(line)); }

  static std::string reason(const Json& before, const Json& after) {
    if (before.at("version") != after.at("version"))
      return fmt::format(" (version {} before, {} now)", text(before.at("version")),
                         text(after.at("version")));
    return before.at("plugin_hash") != after.at("plugin_hash") ? " (the plugin is another build)"
                                                               : "";
  }
};

}  // namespace

std::vector<std::string> compare(const Json& before, const Json& after) {
  Comparison comparison;
  comparison.files("input", before.at("inputs"), after.at("inputs"));
  for (const Json& node : before.at("nodes")) {
    const Json* other = find(after.at("nodes"), "name", node.at("name"));
    if (other != nullptr) comparison.node(node, *other);
  }
  comparison.files("file", before.at("files"), after.at("files"));
  const Json& set_before = before.at("machine").at("instruction_set");
  const Json& set_after = after.at("machine").at("instruction_set");
  if (!comparison.differences.empty() && set_before != set_after)
    comparison.differences.push_back(
        fmt::format("instruction set: {} before, {} now", text(set_before), text(set_after)));
  return comparison.differences;
}

}  // namespace velum::run
