// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

#include "graph/toml.hpp"

namespace velum::graph::toml {

/// Reads UTF-8 one code point at a time, counting lines and columns; CR LF is one '\n'. Throws
/// SyntaxError at the first byte that is no UTF-8 (overlong forms and surrogates are none).
class Utf8Cursor {
 public:
  explicit Utf8Cursor(std::string_view text) : text_(text) { decode(); }

  [[nodiscard]] bool at_end() const { return offset_ >= text_.size(); }
  /// The code point at the cursor; not at the end.
  [[nodiscard]] char32_t peek() const { return current_; }
  [[nodiscard]] Position position() const { return position_; }
  /// Returns the code point at the cursor and moves on.
  char32_t take();

 private:
  void decode();

  std::string_view text_;
  std::size_t offset_ = 0;
  std::size_t length_ = 0;
  char32_t current_ = 0;
  Position position_{1, 1};
};

}  // namespace velum::graph::toml
