// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <glob.h>

#include <cmath>

#include <fmt/format.h>

#include "graph/study_reader.hpp"
#include "graph/units.hpp"

namespace velum::graph {
namespace {

using toml::Kind;

/// The values that an axis describes instead of listing them.
class Reader : public StudyReader {
 public:
  using StudyReader::StudyReader;

  /// range = { from = "60 mm", to = "100 mm", steps = 5, scale = "log" }
  std::vector<toml::Node> range(const toml::Entry& range) const {
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

  /// The files that match a pattern, relative to the graph's folder, by name.
  std::vector<toml::Node> files(const toml::Entry& files) const {
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

 private:
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

  static constexpr std::int64_t kMostSteps = 10'000;
};

}  // namespace

std::vector<toml::Node> read_range(const Check& check, const toml::Entry& range) {
  return Reader(check).range(range);
}

std::vector<toml::Node> read_files(const Check& check, const toml::Entry& files) {
  return Reader(check).files(files);
}

}  // namespace velum::graph
