// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "fake_catalog.hpp"
#include "folder.hpp"
#include "graph/graph.hpp"

namespace velum::test {

inline fake::Catalog& catalog() {
  static fake::Catalog fakes;
  return fakes;
}

inline graph::Loaded load_text(const std::string& text,
                               const std::vector<std::string>& overrides = {}) {
  return graph::load_text(text, "g.toml", overrides, catalog());
}

/// "E0203 14:3 message | hint | known", each in a line of its own.
inline std::vector<std::string> lines_of(const graph::Diagnostics& diagnostics) {
  std::vector<std::string> lines;
  for (const auto& d : diagnostics) {
    std::string line =
        fmt::format("{} {}:{} {}", d.code, d.where.begin.line, d.where.begin.column, d.message);
    if (!d.hint.empty()) line += " | " + d.hint;
    if (!d.known.empty()) line += " | " + d.known;
    lines.push_back(line);
  }
  return lines;
}

inline std::vector<std::string> mistakes(const std::string& text,
                                         const std::vector<std::string>& overrides = {}) {
  return lines_of(load_text(text, overrides).diagnostics);
}

}  // namespace velum::test
