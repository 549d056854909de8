// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "graph/toml_slip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace velum::graph::toml {
namespace {

/// A run of characters between two delimiters of a line, without the blanks around it.
struct Word {
  std::string_view text;
  std::uint32_t begin = 0;  ///< columns, from 1; `end` is one past the last character
  std::uint32_t end = 0;
  char before = '\0';  ///< delimiters; '\0' at the line's ends
  char after = '\0';
};

/// What is said instead of toml++'s words.
struct Slip {
  std::string message;
  std::string hint;
};

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

std::string_view line_of(std::string_view document, std::uint32_t number) {
  for (std::uint32_t i = 1; i < number; ++i) {
    const std::size_t end = document.find('\n');
    if (end == std::string_view::npos) return {};
    document.remove_prefix(end + 1);
  }
  return document.substr(0, document.find('\n'));
}

std::uint32_t column_of(std::string_view line, std::size_t offset) {
  const auto before = line.substr(0, offset);
  return 1 + static_cast<std::uint32_t>(std::ranges::count_if(
                 before, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// The end of the string that begins at `at`, or of the line.
std::size_t skip_string(std::string_view line, std::size_t at) {
  const char quote = line[at];
  for (std::size_t i = at + 1; i < line.size(); ++i) {
    if (line[i] == '\\' && quote == '"')
      ++i;
    else if (line[i] == quote)
      return i + 1;
  }
  return line.size();
}

std::vector<Word> words_of(std::string_view line) {
  constexpr std::string_view kDelimiters = "=,[]{}\"'#";
  std::vector<Word> words;
  char before = '\0';
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t stop = std::min(line.find_first_of(kDelimiters, at), line.size());
    const char after = stop < line.size() ? line[stop] : '\0';
    std::size_t end = stop;
    while (at < end && is_blank(line[at])) ++at;
    while (at < end && is_blank(line[end - 1])) --end;
    if (at < end)
      words.push_back(
          {line.substr(at, end - at), column_of(line, at), column_of(line, end), before, after});
    if (after == '\0' || after == '#') break;
    const bool string = after == '"' || after == '\'';
    at = string ? skip_string(line, stop) : stop + 1;
    before = after;
  }
  return words;
}

/// The value that toml++ was in, or just behind, when it gave up.
std::optional<Word> value_at(std::string_view line, std::uint32_t column) {
  const std::size_t first = line.find_first_not_of(" \t");
  if (first == std::string_view::npos || line[first] == '[') return std::nullopt;  // a header
  std::optional<Word> found;
  for (const Word& word : words_of(line)) {
    const bool value =
        (word.before == '=' || word.before == ',' || word.before == '[') && word.after != '=';
    if (value && word.begin <= column) found = word;
  }
  return found;
}

/// Where the number that `text` begins with ends; 0 when it begins with none.
std::size_t number_end(std::string_view text) {
  std::size_t at = !text.empty() && (text[0] == '+' || text[0] == '-') ? 1 : 0;
  const std::size_t digits = at;
  while (at < text.size() && (is_digit(text[at]) || text[at] == '.' || text[at] == '_')) ++at;
  if (at == digits) return 0;
  std::size_t exponent = at;
  if (exponent < text.size() && (text[exponent] == 'e' || text[exponent] == 'E')) {
    ++exponent;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    if (exponent < text.size() && is_digit(text[exponent]))
      for (at = exponent; at < text.size() && is_digit(text[at]);) ++at;
  }
  return at;
}

std::optional<Slip> slip_of_number(const Word& word) {
  const std::string_view text = word.text;
  const std::size_t end = number_end(text);
  if (end < text.size()) {
    const std::size_t rest = text.find_first_not_of(" \t", end);
    const bool radix =
        text.size() > 1 && text[0] == '0' && (text[1] == 'x' || text[1] == 'o' || text[1] == 'b');
    if (radix || (!is_letter(text[rest]) && text[rest] != '%')) return std::nullopt;
    return Slip{fmt::format("'{}' is text without quotes", text),
                fmt::format("text needs quotes: \"{}\"", text)};
  }
  std::string digits(text.substr(text[0] == '+' ? 1 : 0));
  std::erase(digits, '_');
  const char* last = digits.data() + digits.size();
  const bool whole = digits.find_first_of(".eE") == std::string::npos;
  double number = 0.0;
  std::int64_t integer = 0;
  if (whole && std::from_chars(digits.data(), last, integer).ec == std::errc::result_out_of_range)
    return Slip{fmt::format("{} is beyond what a whole number can be", text),
                "whole numbers go to 9223372036854775807"};
  if (!whole && std::from_chars(digits.data(), last, number).ec == std::errc::result_out_of_range)
    return Slip{fmt::format("{} is beyond what a number can be", text),
                "numbers go to 1.7e308, and down to 5e-324"};
  const std::size_t point = text.find('.');
  if (point != std::string_view::npos && (point == 0 || point + 1 == text.size() ||
                                          !is_digit(text[point - 1]) || !is_digit(text[point + 1])))
    return Slip{fmt::format("'{}' is no number of TOML", text),
                "a number has digits on both sides of its point"};
  if (word.before == '=' && word.after == ',')
    return Slip{fmt::format("a comma after {}", text),
                "numbers have a point, not a comma; several values stand in brackets: [1, 2]"};
  return std::nullopt;
}

std::optional<Slip> slip_of(const Word& word) {
  const std::string_view text = word.text;
  if (number_end(text) > 0) return slip_of_number(word);
  if (text == "true" || text == "false" || text == "inf" || text == "nan" || !is_letter(text[0]))
    return std::nullopt;
  constexpr std::string_view kYes[] = {"True", "TRUE", "yes", "Yes", "YES", "on", "On", "ON"};
  constexpr std::string_view kNo[] = {"False", "FALSE", "no", "No", "NO", "off", "Off", "OFF"};
  if (std::ranges::find(kYes, text) != std::end(kYes))
    return Slip{fmt::format("'{}' is no value", text), "write true, or \"...\" for text"};
  if (std::ranges::find(kNo, text) != std::end(kNo))
    return Slip{fmt::format("'{}' is no value", text), "write false, or \"...\" for text"};
  return Slip{fmt::format("'{}' is text without quotes", text),
              fmt::format("text needs quotes: \"{}\"", text)};
}

}  // namespace

SyntaxError explained(std::string_view document, Region where, const std::string& reason) {
  // Within strings, and about keys, toml++ is clear enough; a long line is none that a hand wrote.
  constexpr std::size_t kLongest = 1000;
  const std::string_view line = line_of(document, where.begin.line);
  const bool about_value = reason.find("string") == std::string::npos &&
                           reason.find("escape") == std::string::npos &&
                           reason.find("redefine") == std::string::npos && line.size() <= kLongest;
  const auto word = about_value ? value_at(line, where.begin.column) : std::nullopt;
  const auto slip = word ? slip_of(*word) : std::nullopt;
  if (!slip) return {where, reason};
  return {
      {{where.begin.line, word->begin}, {where.begin.line, word->end}}, slip->message, slip->hint};
}

}  // namespace velum::graph::toml
