// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "graph/toml_form.hpp"

#include <vector>

#include <fmt/format.h>

#include "graph/toml.hpp"
#include "graph/utf8.hpp"

namespace velum::graph::toml {
namespace {

bool is_bare(char32_t c) {
  return (c >= U'a' && c <= U'z') || (c >= U'A' && c <= U'Z') || (c >= U'0' && c <= U'9') ||
         c == U'_' || c == U'-';
}
bool is_quote(char32_t c) {
  return c == U'"' || c == U'\'';
}
bool is_control(char32_t c) {
  return (c < U' ' && c != U'\t') || c == 0x7F;
}

/// Walks the document once, statement by statement.
class Form {
 public:
  explicit Form(std::string_view document) : text_(document) {}

  void check() {
    while (!at_end()) {
      skip_blanks();
      if (at_end()) return;
      if (peek() == U'\n' || peek() == U'#') {
        skip_line_end();
      } else if (peek() == U'[') {
        header();
      } else {
        if (header_depth_ + key() > kMaxDepth) too_deep();
        assignment();
      }
    }
  }

 private:
  /// A bracket that is open.
  struct Open {
    char32_t bracket;
    Position at;
    int depth;  ///< of all that is around it
    int parts;  ///< of the key that is being read; 0 in a value
  };

  [[nodiscard]] bool at_end() const { return text_.at_end(); }
  [[nodiscard]] char32_t peek() const { return text_.peek(); }
  [[noreturn]] void fail(Position at, const std::string& message, std::string hint = "") const {
    throw SyntaxError({at, {at.line, at.column + 1}}, message, std::move(hint));
  }
  [[noreturn]] void too_deep() const {
    fail(text_.position(), fmt::format("more than {} levels within each other", kMaxDepth));
  }

  char32_t take() {
    const Position at = text_.position();
    const char32_t c = text_.take();
    if (c != U'\n' && is_control(c))
      fail(at, fmt::format("control character U+{:04X}", static_cast<unsigned>(c)),
           c == U'\r' ? "lines end in LF or CR LF" : "");
    return c;
  }
  /// The same outside of strings and comments.
  char32_t take_plain() {
    const Position at = text_.position();
    const char32_t c = take();
    if (c > 0x7F)
      fail(at, fmt::format("character U+{:04X} outside of a string", static_cast<unsigned>(c)),
           "put it in quotes");
    return c;
  }
  void skip_blanks() {
    while (!at_end() && (peek() == U' ' || peek() == U'\t')) take();
  }
  void skip_line_end() {
    skip_blanks();
    if (!at_end() && peek() == U'#')
      while (!at_end() && peek() != U'\n') take();
    if (!at_end() && peek() == U'\n') take();
  }

  void header() {
    const Position at = text_.position();
    take();
    const bool array = !at_end() && peek() == U'[';
    if (array) take();
    skip_blanks();
    header_depth_ = key() + (array ? 1 : 0);
    for (int i = 0; i < (array ? 2 : 1); ++i) {
      if (at_end() || peek() != U']')
        fail(at, "this table header is not closed",
             array ? "it ends in ']]' on the same line" : "it ends in ']' on the same line");
      take();
    }
    skip_blanks();
    if (!at_end() && peek() != U'\n' && peek() != U'#')
      fail(text_.position(), "nothing may follow a table header but a comment");
    skip_line_end();
  }

  /// A bare, quoted or dotted key with the blanks after it. Returns how many parts it has.
  int key() {
    for (int parts = 1;; ++parts) {
      const Position at = text_.position();
      if (at_end() || peek() == U'\n') fail(at, "a key is missing here");
      if (is_quote(peek())) {
        if (string()) fail(at, "a key is no multi-line string");
      } else if (is_bare(peek())) {
        while (!at_end() && is_bare(peek())) take();
      } else {
        take_plain();
        fail(at, "a key was expected here",
             "keys are of letters, digits, '_' and '-', or in quotes");
      }
      skip_blanks();
      if (parts > kMaxDepth) too_deep();
      if (at_end() || peek() != U'.') return parts;
      take();
      skip_blanks();
    }
  }

  /// `= value` up to the end of the line after it; the key has been read.
  void assignment() {
    if (at_end() || peek() != U'=') fail(text_.position(), "'=' was expected after the key");
    take();
    skip_blanks();
    if (at_end() || peek() == U'\n' || peek() == U'#')
      fail(text_.position(), "a value is missing after '='");
    while (!at_end() && (!open_.empty() || (peek() != U'\n' && peek() != U'#'))) value_part();
    if (!open_.empty()) not_closed();
    skip_line_end();
  }

  void value_part() {
    const char32_t c = peek();
    if (is_quote(c)) {
      string();
    } else if (c == U'#') {
      skip_line_end();
    } else if (c == U'[' || c == U'{') {
      push(c);
    } else if (c == U']' || c == U'}') {
      pop(c);
    } else {
      plain(c);
    }
  }

  void plain(char32_t c) {
    const Position at = text_.position();
    take_plain();
    if (open_.empty()) {
      if (c == U'=') fail(at, "a second '=' on this line", "one key and value a line");
      return;
    }
    Open& inner = open_.back();
    if (inner.bracket == U'[') {
      if (c == U'=') not_closed();
      return;
    }
    if (c == U'\n') {
      fail(inner.at, "this inline table does not end on its line", "a '}' is missing");
    } else if (c == U',') {
      inner.parts = 1;
    } else if (c == U'=') {
      if (inner.parts == 0) fail(at, "a second '=' for one key");
      value_depth_ = inner.depth + inner.parts;
      inner.parts = 0;
    } else if (c == U'.' && inner.parts > 0 && inner.depth + ++inner.parts > kMaxDepth) {
      too_deep();
    }
  }

  void push(char32_t bracket) {
    const int around = open_.empty() ? header_depth_ + 1 : value_depth_;
    const int depth = around + 1;
    if (depth > kMaxDepth) too_deep();
    open_.push_back({bracket, text_.position(), depth, bracket == U'{' ? 1 : 0});
    value_depth_ = depth;
    take();
  }

  void pop(char32_t bracket) {
    const char32_t opening = bracket == U']' ? U'[' : U'{';
    if (open_.empty())
      fail(text_.position(), bracket == U']' ? "']' closes nothing" : "'}' closes nothing");
    if (open_.back().bracket != opening) not_closed();
    open_.pop_back();
    value_depth_ = open_.empty() ? 0 : open_.back().depth;
    take();
  }

  [[noreturn]] void not_closed() const {
    const Open& inner = open_.back();
    const bool array = inner.bracket == U'[';
    fail(inner.at, array ? "this array is not closed" : "this inline table is not closed",
         fmt::format("a '{}' is missing before line {}", array ? ']' : '}',
                     text_.position().line + (text_.at_end() ? 1 : 0)));
  }

  /// A string of any of the four forms. True when it is of a multi-line form.
  bool string() {
    const Position at = text_.position();
    const char32_t quote = take();
    bool multi_line = false;
    if (!at_end() && peek() == quote) {
      take();
      if (at_end() || peek() != quote) return false;  // "" or ''
      take();
      multi_line = true;
    }
    for (int run = 0; !at_end();) {
      const char32_t c = take();
      if (c == U'\n' && !multi_line) break;
      if (c == U'\\' && quote == U'"' && !at_end() && peek() != U'\n') take();
      run = c == quote ? run + 1 : 0;
      if (!multi_line && run == 1) return false;
      // Up to two quotes may stand before the three that end it.
      if (multi_line && run >= 3 && (run == 5 || at_end() || peek() != quote)) return true;
    }
    throw SyntaxError({at, {at.line, at.column + 1}}, "this string is not closed",
                      multi_line ? "it ends in three quotes" : "it ends on its line");
  }

  Utf8Cursor text_;
  std::vector<Open> open_;
  int header_depth_ = 0;
  int value_depth_ = 0;  ///< of what is within the innermost bracket
};

}  // namespace

void check_form(std::string_view document) {
  if (document.size() > kMaxBytes)
    throw SyntaxError({{1, 1}, {1, 1}},
                      fmt::format("{} bytes, more than the {} that a graph may have",
                                  document.size(), kMaxBytes));
  Form(document).check();
}

}  // namespace velum::graph::toml
