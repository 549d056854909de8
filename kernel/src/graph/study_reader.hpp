// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "graph/check.hpp"

namespace velum::graph {

/// What the readers of [study] and of its axes share.
class StudyReader {
 public:
  explicit StudyReader(const Check& check)
      : check_(check), report_(check.diagnostics, check.document.files.front().source) {}

 protected:
  [[nodiscard]] const Check& check() const { return check_; }
  [[nodiscard]] const Reporter& report() const { return report_; }
  /// Is it of that kind? Reported when not: "'repeat' must be an integer".
  bool expect(const toml::Entry& entry, toml::Kind kind, const char* what) const;
  /// Reports keys of `table` other than these.
  void only(const toml::Node& table, const std::vector<std::string>& known, const char* of) const;
  /// Reports a node that does not exist.
  bool node(const std::string& name, toml::Region where) const;
  /// "node.name" of a node that exists, or "total" for measures; what is wrong is reported.
  std::optional<MeasureName> dotted(const std::string& text, toml::Region where, const char* what,
                                    bool measure) const;

 private:
  const Check& check_;
  Reporter report_;
};

/// Reads one [[study.vary]]; nothing, with a report, when its form is wrong.
[[nodiscard]] std::optional<Axis> read_axis(const Check& check, const toml::Node& table);

/// The values of `range = { from, to, steps, scale }` and of `files = "scans/*.pcd"`; none, with a
/// report, when there are none or the form is wrong.
[[nodiscard]] std::vector<toml::Node> read_range(const Check& check, const toml::Entry& range);
[[nodiscard]] std::vector<toml::Node> read_files(const Check& check, const toml::Entry& files);

/// Reports what would be lost or confused among the axes of a study: two that vary the same, names
/// that study.csv has already.
void check_axes(const Check& check, const std::vector<Axis>& axes,
                const std::vector<toml::Region>& places);

/// How a value is called in tables: a string is itself, but for control characters.
[[nodiscard]] std::string label_of(const toml::Node& value);

}  // namespace velum::graph
