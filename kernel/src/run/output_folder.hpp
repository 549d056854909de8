// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "files/descriptor.hpp"

namespace velum::run {

/// A run's output folder, held while the run lasts.
///
/// It is made when it is not there. What an earlier run of the same graph left in it is removed; a
/// folder that holds anything else is refused, and so is one that another process writes to. All of
/// it throws Error (Fault::output).
class OutputFolder {
 public:
  /// `graph` names the graph in records; `files` are those that the run will write, relative to the
  /// folder, so that the next run knows them as its own even if this one is killed. What has one of
  /// the names in `others` at its top belongs to somebody else, and stays.
  OutputFolder(const std::filesystem::path& path, const std::string& graph,
               const std::vector<std::string>& files, const std::vector<std::string>& others = {});
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Absolute.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Where the parts of this run exchange files; made on first use, removed at the end.
  [[nodiscard]] std::filesystem::path scratch() const;
  /// Removes scratch files and files that this process was writing, then leaves the folder to
  /// others.
  void close();

 private:
  void lock();
  void refuse_strangers(const std::string& graph);
  void remove_earlier();
  void note(const std::string& graph, const std::vector<std::string>& files);

  std::filesystem::path path_;
  files::Descriptor lock_;
  std::vector<std::filesystem::path> earlier_;  ///< files of ours, relative
  std::set<std::filesystem::path> others_;
};

/// What an earlier run of this graph has left in a folder, or would have: relative to it. Throws
/// Error (Fault::output) when the folder has the results of another graph.
[[nodiscard]] std::vector<std::filesystem::path> files_of_run(const std::filesystem::path& folder,
                                                              const std::string& graph);

inline constexpr const char* kRecordName = "run.json";
inline constexpr const char* kReportName = "report.html";
/// What the report shows of the run's values.
inline constexpr const char* kViewsName = "views.bin";

}  // namespace velum::run
