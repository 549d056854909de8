// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "formats/numbers.hpp"
#include "velum/context.hpp"

namespace velum::formats {

/// Takes one line off `rest`, without its end.
inline std::string_view take_line(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return line;
}

/// Takes the next word off `rest`; empty when there is none.
std::string_view take_word(std::string_view& rest);
/// The words of a line.
std::vector<std::string_view> words_of(std::string_view line);

/// Which lines of a body count: with `comments`, none that begins with # or //. Blank ones never
/// do.
inline bool is_data(std::string_view trimmed_line, bool comments) {
  if (trimmed_line.empty()) return false;
  if (!comments) return true;
  return trimmed_line.front() != '#' && !trimmed_line.starts_with("//");
}

/// A body of text as blocks of whole lines, so that threads can share it. The blocks depend on the
/// text alone.
struct Lines {
  struct Block {
    std::string_view text;
    Index first = 0;  ///< number of its first data line
    Index count = 0;  ///< data lines in it
  };
  std::vector<Block> blocks;
  Index count = 0;
  bool comments = false;
};
Lines split_lines(std::string_view body, bool comments, Context& context);

/// Calls visit(line, number) for the data lines of a block, trimmed.
template <class Visit>
void each_line(const Lines& lines, const Lines::Block& block, const Visit& visit) {
  std::string_view rest = block.text;
  Index number = block.first;
  while (!rest.empty()) {
    const std::string_view line = trimmed(take_line(rest));
    if (is_data(line, lines.comments)) visit(line, number++);
  }
}

}  // namespace velum::formats
