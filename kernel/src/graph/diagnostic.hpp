// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "graph/toml.hpp"
#include "velum/error.hpp"

namespace velum::graph {

/// A mistake in a graph, with all that is needed to show and to mend it.
struct Diagnostic {
  std::string code;  ///< "E0203"; docs/errors.md explains each
  std::string file;  ///< as the user named it
  toml::Region where;
  std::string message;
  std::string hint;         ///< what to do: "did you mean 'size'?"
  std::string known;        ///< what would be right: "known: size, min_points"
  std::string source_line;  ///< the line of the file at `where`; empty: none
  Fault fault = Fault::graph;
};
using Diagnostics = std::vector<Diagnostic>;

/// A file that is being checked.
class Source {
 public:
  /// `name` is how the user called it.
  Source(std::string name, std::string text);
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::string& text() const { return text_; }
  /// The line, counted from 1, without its end; empty when there is none or it is overlong.
  [[nodiscard]] std::string line(std::uint32_t number) const;

 private:
  std::string name_;
  std::string text_;
  std::vector<std::size_t> starts_;  ///< of the lines
};

/// Collects the mistakes of one file.
class Reporter {
 public:
  Reporter(Diagnostics& all, const Source& source) : all_(&all), source_(&source) {}
  /// The same with what the messages are about: "of node 'down' (resampling.voxel_grid)".
  [[nodiscard]] Reporter about(std::string subject) const;
  [[nodiscard]] const std::string& subject() const { return subject_; }
  /// Are there so few mistakes yet that showing the line and what was meant is worth the cost?
  [[nodiscard]] bool helps() const { return all_->size() < 500; }
  /// Adds a mistake; the caller may fill in the rest of it.
  Diagnostic& error(std::string code, toml::Region where, std::string message,  // NOLINT
                    std::string hint = "", std::string known = "") const;

 private:
  Diagnostics* all_;
  const Source* source_;
  std::string subject_;
};

/// "did you mean 'size'?" for the nearest of `known` (Damerau-Levenshtein), or "".
[[nodiscard]] std::string did_you_mean(std::string_view word,
                                       const std::vector<std::string>& known);
/// "known: a, b, c", cut when there are many.
[[nodiscard]] std::string known_list(const std::vector<std::string>& known);

/// error[E0203] graph.toml:14:3  message
///    14 |   sise = 50
///       |   ^^^^ hint  (known)
[[nodiscard]] std::string format(const Diagnostic& diagnostic);
/// All of them, and how many they are. Empty for none.
[[nodiscard]] std::string format(const Diagnostics& diagnostics);
/// The exit status of a check: 0 without mistakes, 4 when all are plugins that do not load, else 2.
[[nodiscard]] int exit_status(const Diagnostics& diagnostics);

}  // namespace velum::graph
