// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "files/descriptor.hpp"
#include "study/journal.hpp"

namespace velum::study {

/// Where a study's folder keeps what its Slurm tasks are given and say.
inline constexpr const char* kTasksName = "slurm";

/// A study's output folder, held while the study runs: study.journal, study.csv, study.json,
/// report.html, cells/ and slurm/. It is made when it is not there. What a run of the same graph
/// has left there stays; a folder with anything else in it is refused, and so are one that another
/// process writes to, and one with another graph's study. All of it throws Error (Fault::output).
class Folder {
 public:
  /// With `resume` an earlier study of this heading goes on (one of another heading is an Error,
  /// Fault::graph), else it is removed.
  Folder(const std::filesystem::path& path, const Journal::Heading& heading, bool resume);
  ~Folder() = default;
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// Absolute.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  void lock();
  /// False when another process has the lock.
  bool hold();
  void refuse_damaged() const;
  /// `ours`: the folder has the journal of a study.
  void refuse_strangers(bool ours, const std::string& graph) const;

  std::filesystem::path path_;
  files::Descriptor lock_;
};

/// The names that the study of this graph has at the top of a folder; none when there is no such
/// study: a run of the graph may use the same folder.
[[nodiscard]] std::vector<std::string> names_of_study(const std::filesystem::path& folder,
                                                      const std::string& graph);

}  // namespace velum::study
