// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "velum/api.hpp"

namespace velum {

/// One entry of a table. Numbers are in the unit of their column.
using Cell = std::variant<double, std::int64_t, std::string>;

/// Rows under named columns with units ("m", "rad", "deg", "%", "" for none).
class VELUM_API Table {
 public:
  struct Heading {
    std::string name;
    std::string unit;
    bool operator==(const Heading&) const = default;
  };

  Table() = default;
  explicit Table(std::vector<Heading> headings);
  Table(std::initializer_list<Heading> headings) : Table(std::vector<Heading>(headings)) {}

  /// Throws Error when the row has not one cell for each heading.
  void add(std::vector<Cell> row);

  [[nodiscard]] const std::vector<Heading>& headings() const { return headings_; }
  [[nodiscard]] const std::vector<std::vector<Cell>>& rows() const { return rows_; }
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] bool empty() const { return rows_.empty(); }
  /// Throws Error naming the column or row that does not exist.
  [[nodiscard]] const Cell& at(std::size_t row, std::string_view heading) const;
  /// The cell as a number; throws Error when it is text.
  [[nodiscard]] double number(std::size_t row, std::string_view heading) const;

 private:
  std::vector<Heading> headings_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace velum
