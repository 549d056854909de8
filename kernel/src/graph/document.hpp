// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "graph/diagnostic.hpp"
#include "graph/study.hpp"
#include "graph/toml.hpp"
#include "graph/units.hpp"

namespace velum::graph {

/// A graph file, or an override, which reads like a file of one line.
struct File {
  Source source;
  std::filesystem::path folder;  ///< that relative paths start from; absolute
  Units units;
  toml::Node root;
};

/// What one key of a node says, and where.
struct Key {
  std::string name;
  toml::Region where;
  toml::Node value;
  const File* file = nullptr;
};

/// A node as written.
struct Draft {
  std::string name;
  toml::Region where;
  const File* file = nullptr;
  std::vector<Key> keys;  ///< overrides applied

  [[nodiscard]] const Key* find(std::string_view key) const;
};

/// A graph as written: includes merged, overrides applied, nothing looked up yet.
struct Document {
  std::deque<File> files;  ///< the main one first; a deque, since drafts point into it
  std::string title;
  std::string units;
  std::vector<Draft> drafts;  ///< by name
  const toml::Entry* study = nullptr;
  bool complete = true;  ///< false when an included file could not be read

  [[nodiscard]] const Draft* find(std::string_view name) const;
};

/// Keys of a node that do not belong to its stage.
[[nodiscard]] const std::vector<std::string>& node_keys();
/// More nodes than this are no graph that anyone has written.
inline constexpr std::size_t kMaxNodes = 10'000;

/// Reads the text of the main file, called `name`, and what it includes. Mistakes are reported;
/// what could be read is returned, nothing when the main file is no TOML.
[[nodiscard]] std::optional<Document> read_document(std::string text,
                                                    const std::filesystem::path& name,
                                                    const std::vector<std::string>& overrides,
                                                    Diagnostics& diagnostics);

/// Makes the document that of one variant of its study. Mistakes are reported.
void vary(Document& document, const Variation& variation, Diagnostics& diagnostics);

}  // namespace velum::graph
