// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "formats/records.hpp"
#include "velum/context.hpp"
#include "velum/files.hpp"

namespace velum::formats {

/// One named value of every point to be written.
struct OutField {
  std::string name;
  FieldType type = FieldType::f32;
  Index width = 1;
  /// Writes the values of points [begin, end) to `to`, `stride` bytes from point to point.
  std::function<void(Index begin, Index end, std::byte* to, std::size_t stride)> fill;

  [[nodiscard]] std::size_t bytes() const {
    return static_cast<std::size_t>(width) * size_of(type);
  }
};
using OutFields = std::vector<OutField>;

/// How a format likes its fields.
struct OutStyle {
  bool pcd = false;       ///< normal_x instead of nx, packed rgb, wide fields
  double unit = 1.0;      ///< of the written coordinates [m]
  bool positions = true;  ///< with x, y, z
};

/// What is to be written of a cloud: positions (in double precision when the origin is not zero, so
/// that nothing is lost), then every column.
OutFields out_fields(const Cloud& cloud, const OutStyle& style);
/// Positions alone, as one field of width 3.
OutField out_positions(const Cloud& cloud, double unit);

std::size_t stride_of(const OutFields& fields);
/// Packed rows of the points [begin, end).
void fill_rows(const OutFields& fields, Index begin, Index end, std::byte* rows);

/// Makes pieces of a file on the node's threads and writes them in order: make(begin, end) gives
/// the bytes of elements [begin, end) of `count`.
void write_pieces(AtomicFile& file, Index count, Index grain, Context& context,
                  const std::function<std::string(Index begin, Index end)>& make);

/// The points as packed rows in a file, in the other byte order if `swapped`.
void write_rows(AtomicFile& file, const OutFields& fields, Index count, bool swapped,
                Context& context);
/// The points as lines of text.
void write_lines(AtomicFile& file, const OutFields& fields, Index count, char separator,
                 Context& context);

/// Appends a number in its shortest exact form, independent of the locale.
void append_number(std::string& text, double value);
void append_number(std::string& text, float value);
void append_number(std::string& text, std::int64_t value);

}  // namespace velum::formats
