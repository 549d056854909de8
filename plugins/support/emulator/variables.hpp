// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lms511/reader.hpp"
#include "lms511/writer.hpp"

namespace velum::emulator {

/// A variable that only holds what is written to it: numbers, each of as many bytes as its digit in
/// `types` says ("112": u8, u8, u16; "f": a float).
struct Variable {
  std::string types;
  std::vector<std::uint32_t> values;
  std::uint32_t most = 0xFFFFFFFF;  ///< of the first number; above it the write is refused
};

/// The plain variables of an LMS 511, as delivered (listing 8014631).
class Variables {
 public:
  Variables();
  [[nodiscard]] bool has(std::string_view name) const { return all_.contains(name); }
  [[nodiscard]] const auto& all() const { return all_; }
  /// Throws Malformed; then nothing is changed.
  void write(lms511::Reader& request);
  void read(std::string_view name, lms511::Writer& answer) const;
  /// Number `index` of a variable.
  [[nodiscard]] std::uint32_t value(std::string_view name, std::size_t index = 0) const;

 private:
  std::map<std::string, Variable, std::less<>> all_;
};

/// Their names.
[[nodiscard]] std::vector<std::string_view> plain_variables();

}  // namespace velum::emulator
