// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "files/descriptor.hpp"
#include "study/outcome.hpp"
#include "study/plan.hpp"

namespace velum::study {

/// What is known of the cells that have ended, on disk as soon as it is known: one JSON line a
/// cell, each with a checksum: one that is damaged costs its own cell only. A line that a kill has
/// cut off is taken away when the journal is opened again.
class Journal {
 public:
  /// What a journal says of its study in its first line.
  struct Heading {
    std::string graph;  ///< its path
    std::string key;    ///< of all that decides the outcomes: graph, axes, seeds, plugins
  };

  /// The heading of a journal that is there; nothing when the file is no journal.
  static std::optional<Heading> heading_of(const std::filesystem::path& file);

  /// Calls `take` for each undamaged line of a journal that begins at byte `from` or later, and
  /// returns where the last one ends. For journals that another process may be writing.
  static std::size_t read(const std::filesystem::path& file, std::size_t from,
                          const std::function<void(const Cell&, Outcome)>& take);

  /// Begins a journal, or goes on with the one that is there and has this heading. Throws Error
  /// (Fault::output).
  Journal(const std::filesystem::path& file, const Heading& heading);

  /// Outcomes by variant and repeat.
  [[nodiscard]] const std::map<std::pair<std::size_t, std::size_t>, Outcome>& outcomes() const {
    return outcomes_;
  }
  void add(const Cell& cell, const Outcome& outcome);
  /// Returns when all that was added is on the disk.
  void sync();

 private:
  void append(const run::Json& json);
  [[noreturn]] void refuse(int error) const;

  std::filesystem::path path_;
  files::Descriptor file_;
  std::map<std::pair<std::size_t, std::size_t>, Outcome> outcomes_;
};

inline constexpr const char* kJournalName = "study.journal";

}  // namespace velum::study
