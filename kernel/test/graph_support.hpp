// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "fake_catalog.hpp"
#include "graph/graph.hpp"

namespace velum::test {

/// A folder that is gone after the test.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "velum-graph-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code fault;
    std::filesystem::remove_all(path_, fault);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

 private:
  std::filesystem::path path_;
};

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
