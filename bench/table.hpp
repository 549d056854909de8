// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>

#include "timing.hpp"

namespace bench {

/// What was measured, as Markdown: a table for each kind, a row for each operation, the sizes side
/// by side in each cell.
class Tables {
 public:
  explicit Tables(std::vector<velum::Index> sizes) : sizes_(std::move(sizes)) {}

  /// Adds one operation at one size and shows it on the error stream.
  void add(const std::string& kind, const Input& input, const Contenders& contenders,
           const std::vector<double>& seconds);
  [[nodiscard]] std::string text() const;

 private:
  struct Row {
    std::string operation;
    std::vector<std::string> names;                           ///< ours first
    std::map<std::string, std::vector<std::string>> by_name;  ///< one entry a size
  };
  struct Kind {
    std::string name;
    std::vector<Row> rows;
  };
  Row& row(const std::string& kind, const std::string& operation);
  void append(std::string& text, const Row& row) const;

  std::vector<velum::Index> sizes_;
  std::vector<Kind> kinds_;
};

}  // namespace bench
