// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "formats/lines.hpp"
#include "formats/memory.hpp"
#include "formats/records.hpp"
#include "formats/source.hpp"

namespace velum::formats {

/// Where the values of a line of text go in a packed row.
struct RowLayout {
  struct Item {
    FieldType type = FieldType::f64;
    std::size_t offset = 0;
  };
  std::vector<Item> items;
  std::size_t stride = 0;
  char separator = ' ';       ///< ' ': blanks; otherwise this one, with blanks around it
  bool loose = false;         ///< commas count as blanks
  bool empty_is_nan = false;  ///< nothing between two separators is NaN

  void add(FieldType type) {
    items.push_back({type, stride});
    stride += size_of(type);
  }
};

/// Reads one value of `type` into `to`; returns its end, or null.
const char* parse_value(const char* begin, const char* end, FieldType type, std::byte* to);

/// Reads a line into `row`; throws with the line's number when it holds anything else.
void parse_row(const Source& source, std::string_view line, const RowLayout& layout,
               std::byte* row);

/// Reads the data lines [first, first + count) of `lines`, which must exist, into packed rows.
Buffer parse_rows(const Source& source, const Lines& lines, Index first, Index count,
                  const RowLayout& layout, Context& context);

}  // namespace velum::formats
