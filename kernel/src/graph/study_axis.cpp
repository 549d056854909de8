// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <glob.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "graph/study_reader.hpp"
#include "graph/units.hpp"

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
      if (expect(*title, Kind::string, "text")) axis_.name = title->value.text;
    if (const toml::Entry* zip = table.find("zip"))
      if (expect(*zip, Kind::string, "text")) axis_.zip = zip->value.text;
  }

  /// Choices of one label are told apart by a number.
  void add(const std::string& label, Variation variation) {
    const auto taken = [&](const std::string& name) {
      return std::ranges::find(axis_.choices, name, &Choice::label) != axis_.choices.end();
    };
    std::string unique = label;
    for (int n = 2; taken(unique); ++n) unique = fmt::format("{} ({})", label, n);
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
      found = steps(*range);
    } else {
      found = matching(*files);
    }
    if (!path) return;
    axis_.name = path->full();
    for (const toml::Node& value : found)
      add(label_of(value), {{}, {{path->node, path->name, value}}});
  }

  /// range = { from = "60 mm", to = "100 mm", steps = 5, scale = "log" }
  std::vector<toml::Node> steps(const toml::Entry& range) const {
    if (!expect(range, Kind::table, "a table such as { from = 1, to = 9, steps = 5 }")) return {};
    only(range.value, {"from", "to", "steps", "scale"}, "'range'");
    const auto end = [&](const char* name) -> std::optional<Amount> {
      const toml::Entry* entry = range.value.find(name);
      if (entry == nullptr) return std::nullopt;
      if (entry->value.is(Kind::string)) return parse_amount(entry->value.text);
      if (entry->value.is(Kind::integer)) return Amount{double(entry->value.integer), ""};
      if (entry->value.is(Kind::number)) return Amount{entry->value.number, ""};
      return std::nullopt;
    };
    const auto from = end("from");
    const auto to = end("to");
    const toml::Entry* count = range.value.find("steps");
    const toml::Entry* scale = range.value.find("scale");
    const bool log = scale != nullptr && scale->value.text == "log";
    const auto refuse = [&](const char* message) {
      report().error("E0601", range.where, message,
                     "write { from = \"60 mm\", to = \"100 mm\", steps = 5, scale = \"log\" }");
      return std::vector<toml::Node>();
    };
    if (!from || !to || from->unit != to->unit)
      return refuse("a range needs 'from' and 'to' with the same unit");
    if (count == nullptr || !count->value.is(Kind::integer) || count->value.integer < 2 ||
        count->value.integer > kMostSteps)
      return refuse("a range needs 'steps', from 2 to 10000");
    if (scale != nullptr && !log && scale->value.text != "linear")
      return refuse("'scale' is \"linear\" or \"log\"");
    if (log && !(from->number > 0.0 && to->number > 0.0))
      return refuse("a logarithmic range lies above 0");
    return spread(*from, *to, count->value.integer, log, range);
  }

  static std::vector<toml::Node> spread(const Amount& from, const Amount& to, std::int64_t count,
                                        bool log, const toml::Entry& range) {
    const bool whole = range.value.find("from")->value.is(Kind::integer) &&
                       range.value.find("to")->value.is(Kind::integer);
    std::vector<toml::Node> nodes;
    for (std::int64_t i = 0; i < count; ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(count - 1);
      double x = log ? from.number * std::pow(to.number / from.number, t)
                     : from.number + t * (to.number - from.number);
      // Six digits are enough to vary by between the ends, and read well in a table.
      if (!whole) x = parse_number(fmt::format("{:.6g}", x)).value_or(x);
      if (i == 0) x = from.number;
      if (i + 1 == count) x = to.number;
      toml::Node node;
      node.where = range.where;
      if (!from.unit.empty()) {
        node.kind = Kind::string;
        node.text = fmt::format("{} {}", x, from.unit);
      } else if (whole) {
        node.kind = Kind::integer;
        node.integer = std::llround(x);
        if (!nodes.empty() && nodes.back().integer == node.integer) continue;
      } else {
        node.kind = Kind::number;
        node.number = x;
      }
      nodes.push_back(std::move(node));
    }
    return nodes;
  }

  /// The files that match a pattern, relative to the graph's folder, by name.
  std::vector<toml::Node> matching(const toml::Entry& files) const {
    if (!expect(files, Kind::string, "text such as \"scans/*.pcd\"")) return {};
    const auto& folder = check().document.files.front().folder;
    glob_t found = {};
    std::vector<toml::Node> nodes;
    std::string pattern;
    for (const char c : folder.string()) {
      if (std::string_view("[]*?{}\\").find(c) != std::string_view::npos) pattern += '\\';
      pattern += c;
    }
    pattern += "/" + files.value.text;
    if (::glob(pattern.c_str(), GLOB_BRACE, nullptr, &found) == 0)
      for (std::size_t i = 0; i < found.gl_pathc; ++i) {
        toml::Node node;
        node.kind = Kind::string;
        node.where = files.value.where;
        node.text = std::filesystem::path(found.gl_pathv[i]).lexically_relative(folder).string();
        nodes.push_back(std::move(node));
      }
    ::globfree(&found);
    if (nodes.empty())
      report().error("E0601", files.value.where,
                     fmt::format("no file matches '{}'", files.value.text),
                     "the pattern is relative to the graph's folder");
    return nodes;
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

  static constexpr std::int64_t kMostSteps = 10'000;
  Axis axis_;
};

}  // namespace

std::optional<Axis> read_axis(const Check& check, const toml::Node& table) {
  return Reader(check).read(table);
}

}  // namespace velum::graph
