// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "graph/printable.hpp"

#include <fmt/format.h>

namespace velum::graph {
namespace {

/// How long the sequence at the start of `text` is, and what it stands for; 0 when it is no UTF-8.
std::size_t sequence(std::string_view text, char32_t& value) {
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0x80) {
    value = first;
    return 1;
  }
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  value = first & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    const auto next = static_cast<unsigned char>(text[i]);
    if ((next & 0xC0U) != 0x80U) return 0;
    value = value << 6U | (next & 0x3FU);
  }
  const bool surrogate = value >= 0xD800 && value <= 0xDFFF;
  return value < kLeast[length] || value > 0x10FFFF || surrogate ? 0 : length;
}

/// Controls of terminals (C0, C1) and of the direction of writing, and marks without a width.
bool steers(char32_t c) {
  return c < 0x20 || (c >= 0x7F && c <= 0x9F) || c == 0xAD || c == 0x61C || c == 0xFEFF ||
         (c >= 0x200B && c <= 0x200F) || (c >= 0x2028 && c <= 0x202E) ||
         (c >= 0x2060 && c <= 0x206F) || c >= 0xE0000;
}

std::string cell_of(std::string_view bytes, char32_t c) {
  if (c == U'\t') return " ";
  if (!steers(c)) return std::string(bytes);
  return c < 0x100 ? fmt::format("\\x{:02X}", static_cast<unsigned>(c))
                   : fmt::format("\\u{:04X}", static_cast<unsigned>(c));
}

}  // namespace

std::vector<std::string> printable_cells(std::string_view text) {
  std::vector<std::string> cells;
  while (!text.empty()) {
    char32_t c = 0;
    const std::size_t length = sequence(text, c);
    cells.push_back(length == 0 ? fmt::format("\\x{:02X}", static_cast<unsigned>(
                                                               static_cast<unsigned char>(text[0])))
                                : cell_of(text.substr(0, length), c));
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return cells;
}

std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    for (const std::string& cell : printable_cells(text.substr(at, end - at))) result += cell;
    if (end < text.size()) result += '\n';
    at = end + 1;
  }
  return result;
}

}  // namespace velum::graph
