// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "formats/assemble.hpp"
#include "formats/lines.hpp"

namespace velum::formats {

/// What the first lines of a text file say of the others.
struct TextLayout {
  char separator = ' ';            ///< ' ' for blanks, ',' or ';'
  std::vector<std::string> names;  ///< one a column; empty when neither header nor caller gave any
  std::size_t columns = 0;         ///< values a line
  std::size_t body = 0;            ///< where the lines of points begin
  std::optional<Index> points;     ///< of a PTS file, whose first line counts them
  std::vector<Sensor> sensors;
};

TextLayout read_text_layout(const Source& source, const std::vector<std::string>& columns);

}  // namespace velum::formats
