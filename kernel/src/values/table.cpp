// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "velum/table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "velum/error.hpp"

namespace velum {

Table::Table(std::vector<Heading> headings) : headings_(std::move(headings)) {}

void Table::add(std::vector<Cell> row) {
  if (row.size() != headings_.size() || row.empty())
    throw Error(Fault::stage, fmt::format("a row of {} cells in a table of {} columns", row.size(),
                                          headings_.size()));
  rows_.push_back(std::move(row));
}

const Cell& Table::at(std::size_t row, std::string_view heading) const {
  const auto found =
      std::find_if(headings_.begin(), headings_.end(),
                   [&](const Heading& candidate) { return candidate.name == heading; });
  if (found == headings_.end())
    throw Error(Fault::stage, fmt::format("the table has no column '{}'", heading));
  if (row >= rows_.size())
    throw Error(Fault::stage, fmt::format("row {} of a table of {} rows", row, rows_.size()));
  return rows_[row][static_cast<std::size_t>(found - headings_.begin())];
}

double Table::number(std::size_t row, std::string_view heading) const {
  const Cell& cell = at(row, heading);
  if (const auto* real = std::get_if<double>(&cell)) return *real;
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*whole);
  throw Error(Fault::stage, fmt::format("'{}' in row {} of column '{}' is not a number",
                                        std::get<std::string>(cell), row, heading));
}

}  // namespace velum
