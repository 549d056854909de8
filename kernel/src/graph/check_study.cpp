// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>

#include "graph/check.hpp"

namespace velum::graph {
namespace {

using toml::Kind;

/// Checks the form of [study]: known keys, right types, nodes that exist.
class Study {
 public:
  explicit Study(const Check& check)
      : check_(check), report_(check.diagnostics, check.document.files.front().source) {}

  void table(const toml::Entry& study) const {
    if (!expect(study, Kind::table, "a table")) return;
    only(study.value, {"title", "repeat", "measure", "vary"}, "[study]");
    if (const toml::Entry* title = study.value.find("title")) expect(*title, Kind::string, "text");
    if (const toml::Entry* repeat = study.value.find("repeat")) this->repeat(*repeat);
    if (const toml::Entry* measure = study.value.find("measure")) {
      if (expect(*measure, Kind::array, "an array such as [\"error.rms\"]"))
        for (const toml::Node& item : measure->value.items) dotted(item, "a measure", true);
    }
    if (const toml::Entry* vary = study.value.find("vary")) {
      if (expect(*vary, Kind::array, "written [[study.vary]]"))
        for (const toml::Node& axis : vary->value.items) this->axis(axis);
    }
  }

 private:
  bool expect(const toml::Entry& entry, Kind kind, const char* what) const {
    if (entry.value.is(kind)) return true;
    report_.error("E0204", entry.value.where, fmt::format("'{}' must be {}", entry.key, what));
    return false;
  }

  void only(const toml::Node& table, const std::vector<std::string>& known, const char* of) const {
    for (const toml::Entry& entry : table.entries)
      if (std::ranges::find(known, entry.key) == known.end())
        report_.error("E0202", entry.where, fmt::format("unknown key '{}' of {}", entry.key, of),
                      did_you_mean(entry.key, known), known_list(known));
  }

  void repeat(const toml::Entry& entry) const {
    if (expect(entry, Kind::integer, "an integer") && entry.value.integer < 1)
      report_.error("E0206", entry.value.where,
                    fmt::format("'repeat' is {}; it must be at least 1", entry.value.integer));
  }

  /// "node.name" with a node that exists, or "total" for measures.
  void dotted(const toml::Node& value, const char* what, bool measure) const {
    const auto dot = value.is(Kind::string) ? value.text.find('.') : std::string::npos;
    if (dot == std::string::npos || dot + 1 == value.text.size()) {
      report_.error("E0601", value.where, fmt::format("{} is written \"node.name\"", what));
      return;
    }
    const std::string name = value.text.substr(0, dot);
    if (!measure || name != "total") node(name, value.where);
  }

  void node(const std::string& name, toml::Region where) const {
    if (check_.document.find(name) != nullptr || !check_.document.complete) return;
    std::vector<std::string> known;
    if (report_.helps())
      for (const Draft& draft : check_.document.drafts) known.push_back(draft.name);
    report_.error("E0404", where,
                  fmt::format("the study names '{}', but there is no such node", name),
                  did_you_mean(name, known), known_list(known));
  }

  void axis(const toml::Node& axis) const {
    if (!axis.is(Kind::table)) {
      report_.error("E0204", axis.where, "an axis of a study must be a table",
                    "write [[study.vary]]");
      return;
    }
    only(axis, {"title", "node", "alternatives", "param", "values", "files"}, "[[study.vary]]");
    const toml::Entry* node = axis.find("node");
    const toml::Entry* param = axis.find("param");
    if ((node == nullptr) == (param == nullptr)) {
      report_.error("E0601", axis.where, "an axis of a study varies either a node or a parameter",
                    "give either node and alternatives, or param and values (or files)");
    } else if (node != nullptr) {
      this->alternatives(axis, *node);
    } else {
      values(axis, *param);
    }
  }

  void alternatives(const toml::Node& axis, const toml::Entry& node) const {
    if (expect(node, Kind::string, "the name of a node"))
      this->node(node.value.text, node.value.where);
    const toml::Entry* list = axis.find("alternatives");
    if (list == nullptr) {
      report_.error("E0601", node.where, "this axis has no alternatives",
                    "add alternatives = [{ use = ... }, ...]");
      return;
    }
    if (!expect(*list, Kind::array, "an array of tables")) return;
    for (const toml::Node& item : list->value.items)
      if (!item.is(Kind::table))
        report_.error("E0204", item.where, "an alternative must be a table such as { use = ... }");
    if (list->value.items.empty())
      report_.error("E0601", list->where, "this axis has no alternatives");
  }

  void values(const toml::Node& axis, const toml::Entry& param) const {
    dotted(param.value, "'param'", false);
    const toml::Entry* values = axis.find("values");
    const toml::Entry* files = axis.find("files");
    if ((values == nullptr) == (files == nullptr)) {
      report_.error("E0601", param.where, "an axis of a parameter has either values or files",
                    "add values = [...]");
    } else if (files != nullptr) {
      expect(*files, Kind::string, "text such as \"scans/*.pcd\"");
    } else if (expect(*values, Kind::array, "an array") && values->value.items.empty()) {
      report_.error("E0601", values->where, "this axis has no values");
    }
  }

  const Check& check_;
  Reporter report_;
};

}  // namespace

void check_study(Check& check) {
  if (check.document.study != nullptr) Study(check).table(*check.document.study);
}

}  // namespace velum::graph
