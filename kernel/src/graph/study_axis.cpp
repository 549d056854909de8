// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <map>
#include <set>

#include <fmt/format.h>

#include "graph/study_reader.hpp"

namespace velum::graph {
namespace {

using toml::Kind;

/// A table [[study.vary]].
class Reader : public StudyReader {
 public:
  using StudyReader::StudyReader;

  std::optional<Axis> read(const toml::Node& table) {
    if (!table.is(Kind::table)) {
      report().error("E0204", table.where, "an axis of a study must be a table",
                     "write [[study.vary]]");
      return std::nullopt;
    }
    only(table,
         {"title", "zip", "node", "alternatives", "param", "values", "range", "files", "rows"},
         "[[study.vary]]");
    const toml::Entry* node = table.find("node");
    const toml::Entry* param = table.find("param");
    const toml::Entry* rows = table.find("rows");
    if ((node != nullptr) + (param != nullptr) + (rows != nullptr) != 1) {
      report().error("E0601", table.where, "an axis of a study varies either a node or a parameter",
                     "give either node and alternatives, or param and values (or range, or files), "
                     "or rows");
      return std::nullopt;
    }
    if (node != nullptr)
      alternatives(table, *node);
    else if (param != nullptr)
      this->param(table, *param);
    else
      this->rows(*rows);
    texts(table);
    return axis_.choices.empty() ? std::nullopt : std::optional(std::move(axis_));
  }

 private:
  void texts(const toml::Node& table) {
    if (const toml::Entry* title = table.find("title"))
      if (expect(*title, Kind::string, "text")) axis_.name = label_of(title->value);
    if (const toml::Entry* zip = table.find("zip"))
      if (expect(*zip, Kind::string, "text")) axis_.zip = zip->value.text;
  }

  /// Choices of one label are told apart by a number.
  void add(const std::string& label, Variation variation) {
    std::string unique = label;
    while (!labels_.insert(unique).second)
      unique = fmt::format("{} ({})", label, ++numbers_[label] + 1);
    axis_.choices.push_back({std::move(unique), std::move(variation)});
  }

  void alternatives(const toml::Node& table, const toml::Entry& entry) {
    if (!expect(entry, Kind::string, "the name of a node")) return;
    const std::string& name = entry.value.text;
    axis_.name = name;
    const bool known = node(name, entry.value.where);
    const toml::Entry* list = table.find("alternatives");
    if (list == nullptr) {
      report().error("E0601", entry.where, "this axis has no alternatives",
                     "add alternatives = [{ use = ... }, ...]");
      return;
    }
    if (!expect(*list, Kind::array, "an array of tables")) return;
    if (list->value.items.empty())
      report().error("E0601", list->where, "this axis has no alternatives");
    for (const toml::Node& item : list->value.items)
      if (item.is(Kind::table) && helpers_are_tables(item)) {
        const toml::Entry* title = item.find("title");
        const toml::Entry* use = item.find("use");
        const toml::Entry* label = title != nullptr ? title : use;
        if (known) add(label == nullptr ? name : label_of(label->value), {{{name, item}}, {}});
      } else if (!item.is(Kind::table)) {
        report().error("E0204", item.where, "an alternative must be a table such as { use = ... }");
      }
  }

  bool helpers_are_tables(const toml::Node& alternative) const {
    const toml::Entry* with = alternative.find("with");
    if (with == nullptr) return true;
    bool right = expect(*with, Kind::table, "a table of nodes such as { normals = { use = ... } }");
    if (right)
      for (const toml::Entry& helper : with->value.entries)
        right = expect(helper, Kind::table, "a node such as { use = ... }") && right;
    return right;
  }

  void param(const toml::Node& table, const toml::Entry& param) {
    const auto path = dotted(param.value.is(Kind::string) ? param.value.text : "",
                             param.value.where, "'param'", false);
    const toml::Entry* values = table.find("values");
    const toml::Entry* range = table.find("range");
    const toml::Entry* files = table.find("files");
    if ((values != nullptr) + (range != nullptr) + (files != nullptr) != 1) {
      report().error("E0601", param.where, "an axis of a parameter has either values or files",
                     "add values = [...]");
      return;
    }
    std::vector<toml::Node> found;
    if (values != nullptr) {
      if (expect(*values, Kind::array, "an array") && values->value.items.empty())
        report().error("E0601", values->where, "this axis has no values");
      found = values->value.items;
    } else if (range != nullptr) {
      found = read_range(check(), *range);
    } else {
      found = read_files(check(), *files);
    }
    if (!path) return;
    axis_.name = path->full();
    for (const toml::Node& value : found)
      add(label_of(value), {{}, {{path->node, path->name, value}}});
  }

  /// rows = [{ title = "calm", "scan.file" = "a.pcd", "truth.file" = "a.ply" }, ...]
  void rows(const toml::Entry& entry) {
    axis_.name = "rows";
    if (!expect(entry, Kind::array, "an array of tables")) return;
    if (entry.value.items.empty()) report().error("E0601", entry.where, "this axis has no rows");
    for (const toml::Node& item : entry.value.items) {
      if (!item.is(Kind::table)) {
        report().error("E0204", item.where,
                       "a row must be a table such as { \"scan.file\" = \"a.pcd\" }");
        continue;
      }
      Variation variation;
      std::string label;
      for (const toml::Entry& cell : item.entries)
        if (cell.key != "title") this->cell(cell, variation, label);
      const toml::Entry* title = item.find("title");
      add(title == nullptr ? label : label_of(title->value), std::move(variation));
    }
  }

  /// "scan.file" = "a.pcd", or without the quotes, which TOML reads as a table in a table.
  void cell(const toml::Entry& cell, Variation& variation, std::string& label) const {
    const auto take = [&](const std::string& path, const toml::Entry& entry) {
      const auto name = dotted(path, entry.where, "a parameter", false);
      if (name) variation.values.push_back({name->node, name->name, entry.value});
      label += (label.empty() ? "" : ", ") + label_of(entry.value);
    };
    if (!cell.value.is(Kind::table)) return take(cell.key, cell);
    for (const toml::Entry& inner : cell.value.entries) take(cell.key + "." + inner.key, inner);
  }

  Axis axis_;
  std::set<std::string> labels_;
  std::map<std::string, int> numbers_;  ///< how many choices of a label got one
};

}  // namespace

std::optional<Axis> read_axis(const Check& check, const toml::Node& table) {
  return Reader(check).read(table);
}

}  // namespace velum::graph
