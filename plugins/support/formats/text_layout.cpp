// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/text_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace velum::formats {
namespace {

constexpr std::size_t kMostColumns = 1000;

using Names = std::vector<std::string>;

char separator_of(std::string_view line) {
  if (line.find(';') != std::string_view::npos) return ';';
  return line.find(',') != std::string_view::npos ? ',' : ' ';
}

/// A cell without quotes, blanks around it and a unit in brackets behind it.
std::string name_of_cell(std::string_view cell) {
  cell = trimmed(cell);
  if (cell.size() >= 2 && (cell.front() == '"' || cell.front() == '\'') &&
      cell.back() == cell.front())
    cell = trimmed(cell.substr(1, cell.size() - 2));
  const std::size_t bracket = cell.find('[');
  if (bracket != std::string_view::npos && cell.back() == ']')
    cell = trimmed(cell.substr(0, bracket));
  return std::string(cell);
}

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  if (separator == ' ') return words_of(line);
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t end = line.find(separator);
    cells.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return cells;
    line.remove_prefix(end + 1);
  }
}

Names names_of(std::string_view line, char separator) {
  Names names;
  for (const std::string_view cell : cells_of(line, separator)) names.push_back(name_of_cell(cell));
  return names;
}

bool names_a_cloud(const Names& names) {
  const auto has = [&](std::string_view name) {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& other) { return lower(other) == name; });
  };
  return has("x") && has("y") && has("z");
}

/// Does a line that begins with this cell name columns? Names do not begin as numbers do.
bool begins_header(std::string_view cell) {
  constexpr std::string_view kOfNumbers = "+-.0123456789";
  return !cell.empty() && kOfNumbers.find(cell.front()) == std::string_view::npos && !as_real(cell);
}

class LayoutReader {
 public:
  explicit LayoutReader(const Source& source) : source_(source) {}

  TextLayout read(const Names& columns) {
    std::string_view rest = source_.text();
    if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // a byte order mark
    std::string_view line = next_data(rest);
    if (line.empty())
      throw Error(Fault::input, "the file has no line of points").at(source_.name());
    layout_.separator = separator_of(line);
    auto cells = cells_of(line, layout_.separator);
    if (cells.size() == 1 && as_integer(cells[0])) {
      read_count(line, cells[0]);
      line = next_data(rest);
      layout_.separator = separator_of(line);
    } else if (begins_header(cells[0])) {
      header_ = line;
      layout_.names = names_of(line, layout_.separator);
      line = next_data(rest);
    }
    begin_body(line);
    name_columns(columns);
    return std::move(layout_);
  }

 private:
  /// The next line that is no comment; sensors and names in the comments before it are kept.
  std::string_view next_data(std::string_view& rest) {
    while (!rest.empty()) {
      const std::string_view line = trimmed(take_line(rest));
      if (is_data(line, true)) return line;
      if (line.empty()) continue;
      const std::string_view comment =
          trimmed(line.substr(std::min(line.find_first_not_of("#/"), line.size())));
      read_sensor_line(comment, layout_.sensors);
      if (names_a_cloud(names_of(comment, separator_of(comment)))) comment_ = comment;
    }
    return {};
  }

  void read_count(std::string_view line, std::string_view cell) {
    const std::int64_t count = *as_integer(cell);
    if (count < 0) throw source_.bad_line(line, fmt::format("{} points", count));
    layout_.points = count;
  }

  void begin_body(std::string_view line) {
    layout_.body = line.empty() ? source_.size()
                                : static_cast<std::size_t>(line.data() - source_.text().data());
    layout_.columns = cells_of(line, layout_.separator).size();
    if (line.empty()) layout_.columns = layout_.names.size();
    if (layout_.columns > kMostColumns)
      throw source_.bad_line(
          line, fmt::format("{} columns, at most {} are read", layout_.columns, kMostColumns));
  }

  void name_columns(const Names& columns) {
    if (!header_.empty() && layout_.names.size() != layout_.columns)
      throw source_.bad_line(
          header_, fmt::format("{} names for {} columns", layout_.names.size(), layout_.columns));
    if (layout_.names.empty() && !comment_.empty()) {
      Names names = names_of(comment_, separator_of(comment_));
      if (names.size() == layout_.columns) layout_.names = std::move(names);
    }
    if (!columns.empty()) {
      if (columns.size() != layout_.columns)
        throw source_.bad_line(layout_.body, fmt::format("found {} columns, expected {} (parameter "
                                                         "'columns')",
                                                         layout_.columns, columns.size()));
      layout_.names = columns;
    }
    std::set<std::string> seen;
    for (const std::string& name : layout_.names)
      if (name != "_" && !name.empty() && !seen.insert(lower(name)).second)
        throw Error(Fault::input, "two columns called '" + name + "'").at(source_.name());
    if (!layout_.names.empty() && !names_a_cloud(layout_.names))
      throw source_
          .bad_line(header_.empty() ? source_.text() : header_,
                    "the columns' names have no x, y and z")
          .hint("name them by columns = [\"x\", \"y\", \"z\", ...]; \"_\" leaves one out");
    if (layout_.columns < 3)
      throw source_.bad_line(layout_.body,
                             fmt::format("found {} values on a line, expected at least "
                                         "x, y and z",
                                         layout_.columns));
  }

  const Source& source_;
  std::string_view header_;
  std::string_view comment_;
  TextLayout layout_;
};

}  // namespace

TextLayout read_text_layout(const Source& source, const std::vector<std::string>& columns) {
  return LayoutReader(source).read(columns);
}

}  // namespace velum::formats
