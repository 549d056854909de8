// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "files/descriptor.hpp"
#include "study/journal.hpp"

namespace velum::study {

/// A study's output folder, held while the study runs: study.journal, study.csv, study.json,
/// report.html and cells/. It is made when it is not there. A folder with anything else in it is
/// refused, and so are one that another process writes to, and one with another graph's study. All
/// of it throws Error (Fault::output).
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
  /// `ours`: the folder has the journal of a study.
  void refuse_strangers(bool ours) const;

  std::filesystem::path path_;
  files::Descriptor lock_;
};

}  // namespace velum::study
