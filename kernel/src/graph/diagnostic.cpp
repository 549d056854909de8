// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "graph/diagnostic.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "graph/place.hpp"
#include "graph/printable.hpp"

namespace velum::graph {
namespace {

constexpr std::size_t kMaxKnown = 12;       // names that a list of known ones shows
constexpr std::size_t kMaxColumns = 100;    // of a line of the graph that is shown
constexpr std::size_t kMaxLine = 10'000;    // longer lines are not shown
constexpr std::size_t kMaxCompared = 2000;  // names that a word is compared with
constexpr std::size_t kMaxWord = 64;        // longer words are not compared

bool starts_code_point(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
}

/// How many columns the cells [begin, end) take, where those that are not there take one each.
std::size_t width(const std::vector<std::string>& cells, std::size_t begin, std::size_t end) {
  std::size_t columns = 0;
  for (std::size_t i = begin; i < end; ++i)
    columns += i < cells.size()
                   ? static_cast<std::size_t>(std::ranges::count_if(cells[i], starts_code_point))
                   : 1;
  return columns;
}

// Optimal string alignment: insertions, deletions, substitutions and swaps of neighbours.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t cost = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + cost});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

/// The lines below the first: source, caret and advice.
std::string excerpt(const Diagnostic& diagnostic, const std::string& advice) {
  const std::string number = fmt::format("{:>5}", diagnostic.where.begin.line);
  const std::string gutter(number.size(), ' ');
  const std::vector<std::string> cells = printable_cells(diagnostic.source_line);
  const std::size_t column =
      diagnostic.where.begin.column == 0 ? 0 : diagnostic.where.begin.column - 1;
  // A long line is shown from a little before the place.
  const std::size_t skipped = column > kMaxColumns * 3 / 4 ? column - kMaxColumns / 4 : 0;
  const std::size_t room = std::min(cells.size(), skipped + kMaxColumns);
  std::string shown;
  for (std::size_t i = skipped; i < room; ++i) shown += cells[i];

  const bool one_line = diagnostic.where.end.line == diagnostic.where.begin.line;
  const std::size_t last = one_line ? diagnostic.where.end.column - 1 : cells.size();
  const std::size_t end = std::max<std::size_t>(std::min(last, room), column + 1);
  return fmt::format("{} |   {}\n{} |   {}{}{}{}\n", number, shown, gutter,
                     std::string(width(cells, skipped, column), ' '),
                     std::string(width(cells, column, end), '^'), advice.empty() ? "" : " ",
                     advice);
}

}  // namespace

Source::Source(std::string name, std::string text)
    : name_(std::move(name)), text_(std::move(text)), starts_{0} {
  for (std::size_t i = 0; i < text_.size(); ++i)
    if (text_[i] == '\n') starts_.push_back(i + 1);
}

std::string Source::line(std::uint32_t number) const {
  if (number == 0 || number > starts_.size()) return {};
  const std::string_view rest = std::string_view(text_).substr(starts_[number - 1]);
  const std::string_view line = rest.substr(0, rest.find_first_of("\r\n"));
  return std::string(line.size() > kMaxLine ? "" : line);
}

Reporter Reporter::about(std::string subject) const {
  Reporter reporter = *this;
  reporter.subject_ = std::move(subject);
  return reporter;
}

Diagnostic& Reporter::error(std::string code, toml::Region where, std::string message,
                            std::string hint, std::string known) const {
  const bool shown = helps();
  Diagnostic& added = all_->emplace_back();
  added.code = std::move(code);
  added.file = source_->name();
  added.where = where;
  added.message = std::move(message);
  added.hint = std::move(hint);
  added.known = std::move(known);
  if (shown) added.source_line = source_->line(where.begin.line);
  return added;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  if (word.size() > kMaxWord || known.size() > kMaxCompared) return {};
  // Two slips in a short word make another word.
  std::size_t best = std::max<std::size_t>(word.size() / 3, 1) + 1;
  const std::string* nearest = nullptr;
  for (const std::string& candidate : known) {
    if (candidate.size() > kMaxWord) continue;
    const std::size_t d = distance(word, candidate);
    if (d >= best || d >= candidate.size()) continue;
    best = d;
    nearest = &candidate;
  }
  return nearest == nullptr ? "" : fmt::format("did you mean '{}'?", *nearest);
}

std::string known_list(const std::vector<std::string>& known) {
  if (known.empty()) return {};
  const std::size_t shown = std::min(known.size(), kMaxKnown);
  const std::vector<std::string> first(known.begin(),
                                       known.begin() + static_cast<std::ptrdiff_t>(shown));
  return fmt::format("known: {}{}", fmt::join(first, ", "), shown < known.size() ? ", ..." : "");
}

std::string place_of(const Diagnostic& diagnostic) {
  if (diagnostic.where.begin.line == 0) return diagnostic.file;
  return fmt::format("{}:{}:{}", diagnostic.file, diagnostic.where.begin.line,
                     diagnostic.where.begin.column);
}

std::string format(const Diagnostic& diagnostic) {
  std::string advice = diagnostic.hint;
  if (!diagnostic.known.empty())
    advice += fmt::format("{}({})", advice.empty() ? "" : "  ", diagnostic.known);
  advice = printable(advice);
  std::string text = fmt::format("error[{}] {}  {}\n", diagnostic.code,
                                 printable(place_of(diagnostic)), printable(diagnostic.message));
  if (!diagnostic.source_line.empty()) return text + excerpt(diagnostic, advice);
  return advice.empty() ? text : text + fmt::format("      = {}\n", advice);
}

std::string format(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) text += format(diagnostic);
  if (diagnostics.size() > 1) text += fmt::format("{} mistakes\n", diagnostics.size());
  return text;
}

int exit_status(const Diagnostics& diagnostics) {
  if (diagnostics.empty()) return 0;
  const Fault first = diagnostics.front().fault;
  const bool all =
      std::ranges::all_of(diagnostics, [&](const Diagnostic& d) { return d.fault == first; });
  return static_cast<int>(all ? first : Fault::graph);
}

}  // namespace velum::graph
