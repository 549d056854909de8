// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/lines.hpp"

namespace velum::formats {
namespace {

/// Bytes a block: large enough that sharing costs nothing, small enough to balance two threads.
constexpr std::size_t kBlock = std::size_t{1} << 18U;

Index count_lines(std::string_view rest, bool comments) {
  Index count = 0;
  while (!rest.empty()) count += is_data(trimmed(take_line(rest)), comments) ? 1 : 0;
  return count;
}

}  // namespace

std::string_view take_word(std::string_view& rest) {
  std::size_t begin = 0;
  while (begin < rest.size() && is_blank(rest[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest.size() && !is_blank(rest[end])) ++end;
  const std::string_view word = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return word;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line))
    words.push_back(word);
  return words;
}

Lines split_lines(std::string_view body, bool comments, Context& context) {
  Lines lines;
  lines.comments = comments;
  for (std::size_t begin = 0; begin < body.size();) {
    const std::size_t newline = body.find('\n', std::min(begin + kBlock, body.size()) - 1);
    const std::size_t end = newline == std::string_view::npos ? body.size() : newline + 1;
    lines.blocks.push_back({body.substr(begin, end - begin), 0, 0});
    begin = end;
  }
  context.run_chunks(static_cast<Index>(lines.blocks.size()), [&](Index i) {
    Lines::Block& block = lines.blocks[static_cast<std::size_t>(i)];
    block.count = count_lines(block.text, comments);
  });
  for (Lines::Block& block : lines.blocks) {
    block.first = lines.count;
    lines.count += block.count;
  }
  return lines;
}

}  // namespace velum::formats
