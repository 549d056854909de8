// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "graph/study_slurm.hpp"

#include <fmt/format.h>

#include "graph/settings.hpp"
#include "graph/units.hpp"

namespace velum::graph {
namespace {

using toml::Kind;

constexpr std::int64_t kLargest = 1'000'000;

class Reader {
 public:
  Reader(const toml::Entry& entry, const Reporter& report) : entry_(entry), report_(report) {}

  void text(std::string& to) const {
    if (expect(Kind::string, "text")) to = entry_.value.text;
  }

  [[nodiscard]] std::optional<std::int64_t> count() const {
    if (!expect(Kind::integer, "an integer")) return std::nullopt;
    const std::int64_t number = entry_.value.integer;
    if (number >= 1 && number <= kLargest) return number;
    report_.error("E0206", entry_.value.where,
                  fmt::format("'{}' is {}; it must be from 1 to {}", entry_.key, number, kLargest));
    return std::nullopt;
  }

  void time(std::optional<double>& to) const {
    Parameter parameter;
    parameter.name = entry_.key;
    parameter.type = ParameterType::duration;
    parameter.range = above(0.0);
    const Setting setting = parse_setting(parameter, entry_.value, {}, report_);
    if (setting.is_set()) to = std::get<double>(setting.value);
  }

  void memory(std::optional<std::uint64_t>& to) const {
    if (entry_.value.is(Kind::string)) to = parse_memory(entry_.value.text);
    if (!to)
      report_.error("E0204", entry_.value.where, "'memory' must be text such as \"2 GB\"", "",
                    known_list(byte_units()));
  }

  void texts(std::vector<std::string>& to) const {
    if (!expect(Kind::array, "an array of text")) return;
    for (const toml::Node& item : entry_.value.items)
      if (item.is(Kind::string))
        to.push_back(item.text);
      else
        report_.error("E0204", item.where, "an option of sbatch must be text",
                      "write options = [\"--constraint=haswell\"]");
  }

 private:
  bool expect(Kind kind, const char* what) const {
    if (entry_.value.is(kind)) return true;
    report_.error("E0204", entry_.value.where, fmt::format("'{}' must be {}", entry_.key, what));
    return false;
  }

  const toml::Entry& entry_;
  const Reporter& report_;
};

}  // namespace

void read_slurm(const toml::Entry& entry, const Reporter& report, Slurm& slurm) {
  static const std::vector<std::string> known = {"account", "partition", "time",  "memory",
                                                 "cpus",    "cells",     "array", "options"};
  const Reader reader(entry, report);
  if (entry.key == "account")
    reader.text(slurm.account);
  else if (entry.key == "partition")
    reader.text(slurm.partition);
  else if (entry.key == "time")
    reader.time(slurm.seconds);
  else if (entry.key == "memory")
    reader.memory(slurm.bytes);
  else if (entry.key == "cpus")
    slurm.cpus = static_cast<int>(reader.count().value_or(1));
  else if (entry.key == "cells")
    slurm.cells = reader.count();
  else if (entry.key == "array")
    slurm.array = static_cast<std::size_t>(reader.count().value_or(1));
  else if (entry.key == "options")
    reader.texts(slurm.options);
  else
    report.error("E0202", entry.where, fmt::format("unknown key '{}' of [study.slurm]", entry.key),
                 did_you_mean(entry.key, known), known_list(known));
}

void set_slurm(const std::string& text, Slurm& slurm) {
  const auto equals = text.find('=');
  Diagnostics mistakes;
  const Source source("--slurm", text);
  const Reporter report(mistakes, source);
  if (equals == std::string::npos)
    report.error("E0202", {}, fmt::format("'{}' is no setting", text), "write KEY=VALUE");
  else
    read_slurm({text.substr(0, equals), {}, toml::parse_value(text.substr(equals + 1))}, report,
               slurm);
  if (mistakes.empty()) return;
  const Diagnostic& first = mistakes.front();
  throw Error(Fault::graph, first.message)
      .at("--slurm " + text)
      .hint(first.hint.empty() ? first.known : first.hint);
}

Slurm slurm_in(const std::string& graph) {
  Slurm slurm;
  const toml::Node root = toml::parse(graph);
  const toml::Entry* study = root.find("study");
  const toml::Entry* said = study == nullptr ? nullptr : study->value.find("slurm");
  if (said == nullptr) return slurm;
  Diagnostics none;
  const Source source("", "");
  for (const toml::Entry& key : said->value.entries) read_slurm(key, Reporter(none, source), slurm);
  return slurm;
}

}  // namespace velum::graph
