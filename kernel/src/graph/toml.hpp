// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// TOML 1.0 documents with the place of everything in them. Any bytes end in a document or in a
/// SyntaxError: the parser below (toml++ 3.3.0) is given only what it is known to survive.
namespace velum::graph::toml {

/// Line and column count from 1; a column is one code point. Line 0: unknown.
struct Position {
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  auto operator<=>(const Position&) const = default;
};
/// `end` is one past the last character.
struct Region {
  Position begin;
  Position end;
};

enum class Kind : std::uint8_t {
  table,
  array,
  string,
  integer,
  number,
  boolean,
  offset_date_time,
  local_date_time,
  local_date,
  local_time
};
/// "table", "array", "string", ... as in messages.
[[nodiscard]] std::string_view name_of(Kind kind);

struct Entry;

/// A value with its place. Only the member that `kind` tells has a meaning.
struct Node {
  Kind kind = Kind::table;
  Region where;
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0.0;
  std::string text;            ///< of a string; of dates and times as RFC 3339 writes them
  std::vector<Node> items;     ///< of an array
  std::vector<Entry> entries;  ///< of a table, in the order of the file

  [[nodiscard]] bool is(Kind other) const { return kind == other; }
  /// The entry called `key`, or null; also when this is no table.
  [[nodiscard]] const Entry* find(std::string_view key) const;
};

/// One key of a table.
struct Entry {
  std::string key;
  Region where;  ///< of the key
  Node value;
};

class SyntaxError : public std::runtime_error {
 public:
  SyntaxError(Region where, const std::string& message, std::string hint = "")
      : std::runtime_error(message), where_(where), hint_(std::move(hint)) {}
  [[nodiscard]] Region where() const { return where_; }
  [[nodiscard]] const std::string& hint() const { return hint_; }

 private:
  Region where_;
  std::string hint_;
};

/// Larger documents, and deeper nested ones (brackets and dotted keys), are refused.
inline constexpr std::size_t kMaxBytes = std::size_t{1} << 20U;
inline constexpr int kMaxDepth = 64;

/// Throws SyntaxError.
[[nodiscard]] Node parse(std::string_view document);
/// A value as on a command line: TOML, or else the text itself as a string ("5 mm", "largest").
[[nodiscard]] Node parse_value(std::string_view text);
/// `text` in quotes, with what must be escaped in a basic string.
[[nodiscard]] std::string quoted(std::string_view text);

}  // namespace velum::graph::toml
