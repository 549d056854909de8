// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "graph/study_reader.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "graph/settings.hpp"
#include "graph/study_slurm.hpp"
#include "graph/units.hpp"

namespace velum::graph {
namespace {

using toml::Kind;

/// The table [study].
class Reader : public StudyReader {
 public:
  using StudyReader::StudyReader;

  Study read(const toml::Entry& entry) {
    if (!expect(entry, Kind::table, "a table")) return {};
    const toml::Node& table = entry.value;
    only(table,
         {"title", "repeat", "seed", "measure", "vary", "exclude", "sample", "reference", "timing",
          "timeout", "memory", "slurm"},
         "[study]");
    if (const toml::Entry* title = table.find("title"))
      if (expect(*title, Kind::string, "text")) study_.title = label_of(title->value);
    seeds(table);
    measures(table);
    axes(table);
    chosen(table);
    conditions(table);
    if (const toml::Entry* slurm = table.find("slurm"); slurm != nullptr) this->slurm(*slurm);
    return std::move(study_);
  }

 private:
  std::optional<std::int64_t> count(const toml::Node& table, const char* name) const {
    const toml::Entry* entry = table.find(name);
    if (entry == nullptr || !expect(*entry, Kind::integer, "an integer")) return std::nullopt;
    if (entry->value.integer >= 1) return entry->value.integer;
    report().error("E0206", entry->value.where,
                   fmt::format("'{}' is {}; it must be at least 1", name, entry->value.integer));
    return std::nullopt;
  }

  void seeds(const toml::Node& table) {
    const auto repeats = count(table, "repeat").value_or(1);
    const auto first = count(table, "seed").value_or(1);
    if (repeats > kMostRepeats) {
      report().error("E0206", table.find("repeat")->value.where,
                     fmt::format("'repeat' is {}; it must be at most {}", repeats, kMostRepeats));
      return;
    }
    for (std::int64_t k = 0; k < repeats; ++k)
      study_.seeds.push_back(static_cast<std::uint64_t>(first + k));
  }

  void measures(const toml::Node& table) {
    const toml::Entry* entry = table.find("measure");
    if (entry == nullptr || !expect(*entry, Kind::array, "an array such as [\"error.rms\"]"))
      return;
    for (const toml::Node& item : entry->value.items)
      if (auto name = dotted(item.is(Kind::string) ? item.text : "", item.where, "a measure", true);
          name && std::ranges::find(study_.measures, *name) == study_.measures.end())
        study_.measures.push_back(std::move(*name));
  }

  void axes(const toml::Node& table) {
    const toml::Entry* entry = table.find("vary");
    if (entry == nullptr || !expect(*entry, Kind::array, "written [[study.vary]]")) return;
    std::vector<toml::Region> places;
    for (const toml::Node& item : entry->value.items) {
      auto axis = read_axis(check(), item);
      if (!axis) continue;
      places.push_back(item.where);
      study_.axes.push_back(std::move(*axis));
    }
    check_axes(check(), study_.axes, places);
    zipped(entry->where);
  }

  void zipped(toml::Region where) const {
    std::map<std::string, std::size_t> sizes;
    for (const Axis& axis : study_.axes) {
      if (axis.zip.empty()) continue;
      const auto [known, fresh] = sizes.emplace(axis.zip, axis.choices.size());
      if (!fresh && known->second != axis.choices.size())
        report().error("E0601", where,
                       fmt::format("axis '{}' has {} values, another of zip = '{}' has {}",
                                   axis.name, axis.choices.size(), axis.zip, known->second),
                       "axes that go along together have the same number of values");
    }
  }

  /// { axis = "label", ... }
  std::optional<Labels> labels(const toml::Node& table) const {
    if (!table.is(Kind::table)) {
      report().error("E0204", table.where,
                     "expected a table such as { mesh = \"meshing.poisson\" }");
      return std::nullopt;
    }
    Labels labels;
    for (const toml::Entry& entry : table.entries) {
      const auto axis = std::ranges::find(study_.axes, entry.key, &Axis::name);
      std::vector<std::string> known;
      if (axis == study_.axes.end()) {
        for (const Axis& other : study_.axes) known.push_back(other.name);
        report().error("E0601", entry.where, fmt::format("there is no axis '{}'", entry.key),
                       did_you_mean(entry.key, known), known_list(known));
        continue;
      }
      const std::string label = label_of(entry.value);
      for (const Choice& choice : axis->choices) known.push_back(choice.label);
      if (std::ranges::find(known, label) == known.end())
        report().error("E0601", entry.value.where,
                       fmt::format("axis '{}' has no '{}'", entry.key, label),
                       did_you_mean(label, known), known_list(known));
      labels.emplace(entry.key, label);
    }
    return labels;
  }

  void chosen(const toml::Node& table) {
    if (const toml::Entry* exclude = table.find("exclude");
        exclude != nullptr && expect(*exclude, Kind::array, "an array of tables"))
      for (const toml::Node& item : exclude->value.items)
        if (auto found = labels(item)) study_.exclude.push_back(std::move(*found));
    if (const auto sample = count(table, "sample"))
      study_.sample = static_cast<std::size_t>(*sample);
    if (const toml::Entry* reference = table.find("reference"))
      study_.reference = labels(reference->value);
  }

  void conditions(const toml::Node& table) {
    if (const toml::Entry* timing = table.find("timing")) {
      const std::vector<std::string> known = {"shared", "exclusive"};
      study_.exclusive = timing->value.is(Kind::string) && timing->value.text == "exclusive";
      if (!timing->value.is(Kind::string) ||
          std::ranges::find(known, timing->value.text) == known.end())
        report().error("E0208", timing->value.where, "'timing' must be one of two words", "",
                       known_list(known));
    }
    if (const toml::Entry* timeout = table.find("timeout")) {
      Parameter parameter;
      parameter.name = "timeout";
      parameter.type = ParameterType::duration;
      parameter.range = above(0.0);
      const Setting setting = parse_setting(parameter, timeout->value, {}, report());
      if (setting.is_set()) study_.seconds = std::get<double>(setting.value);
    }
    if (const toml::Entry* memory = table.find("memory")) {
      if (memory->value.is(Kind::string)) study_.bytes = parse_memory(memory->value.text);
      if (!study_.bytes)
        report().error("E0204", memory->value.where, "'memory' must be text such as \"2 GB\"", "",
                       known_list(byte_units()));
    }
  }

  /// Only its mistakes: who runs the study by Slurm reads it again.
  void slurm(const toml::Entry& entry) const {
    Slurm ignored;
    if (expect(entry, Kind::table, "a table"))
      for (const toml::Entry& key : entry.value.entries) read_slurm(key, report(), ignored);
  }

  static constexpr std::int64_t kMostRepeats = 100'000;
  Study study_;
};

}  // namespace

bool StudyReader::expect(const toml::Entry& entry, Kind kind, const char* what) const {
  if (entry.value.is(kind)) return true;
  report_.error("E0204", entry.value.where, fmt::format("'{}' must be {}", entry.key, what));
  return false;
}

void StudyReader::only(const toml::Node& table, const std::vector<std::string>& known,
                       const char* of) const {
  for (const toml::Entry& entry : table.entries)
    if (std::ranges::find(known, entry.key) == known.end())
      report_.error("E0202", entry.where, fmt::format("unknown key '{}' of {}", entry.key, of),
                    did_you_mean(entry.key, known), known_list(known));
}

bool StudyReader::node(const std::string& name, toml::Region where) const {
  if (check_.document.find(name) != nullptr) return true;
  if (!check_.document.complete) return false;
  std::vector<std::string> known;
  if (report_.helps())
    for (const Draft& draft : check_.document.drafts) known.push_back(draft.name);
  report_.error("E0404", where,
                fmt::format("the study names '{}', but there is no such node", name),
                did_you_mean(name, known), known_list(known));
  return false;
}

std::optional<MeasureName> StudyReader::dotted(const std::string& text, toml::Region where,
                                               const char* what, bool measure) const {
  const auto dot = text.find('.');
  if (dot == std::string::npos || dot + 1 == text.size()) {
    report_.error("E0601", where, fmt::format("{} is written \"node.name\"", what));
    return std::nullopt;
  }
  MeasureName name{text.substr(0, dot), text.substr(dot + 1)};
  if ((!measure || name.node != "total") && !node(name.node, where)) return std::nullopt;
  return name;
}

std::string label_of(const toml::Node& value) {
  if (!value.is(Kind::string)) return value_text(value);
  std::string label;
  for (const char c : value.text)
    if (const auto code = static_cast<unsigned char>(c); code < 0x20 || code == 0x7F)
      label += fmt::format("\\x{:02x}", code);
    else
      label += c;
  return label;
}

std::optional<Study> read_study(const Check& check) {
  if (check.document.study == nullptr) return std::nullopt;
  return Reader(check).read(*check.document.study);
}

}  // namespace velum::graph
