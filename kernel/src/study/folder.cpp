// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <set>
#include <string_view>
#include <thread>

#include "files/lock.hpp"
#include "run/output_folder.hpp"
#include "velum/error.hpp"

namespace velum::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLock = ".velum.lock";
constexpr std::array<std::string_view, 7> kOurs = {
    kJournalName, "study.csv", "study.json", "report.html", "cells", kTasksName, kLock};

constexpr std::chrono::milliseconds kWait{20};
constexpr int kMostWaits = 100;

[[noreturn]] void refuse(const fs::path& path, const std::string& message,
                         const std::string& hint) {
  throw Error(Fault::output, message).at(path.string()).hint(hint);
}

}  // namespace

Folder::Folder(const fs::path& path, const Journal::Heading& heading, bool resume)
    : path_(fs::absolute(path).lexically_normal()) {
  std::error_code failed;
  fs::create_directories(path_, failed);
  if (!fs::is_directory(path_))
    refuse(path_, failed ? "the folder cannot be made: " + failed.message() : "not a folder",
           "choose another folder with --out");
  lock();
  const auto earlier = Journal::heading_of(path_ / kJournalName);
  if (!earlier) refuse_damaged();
  refuse_strangers(earlier.has_value(), heading.graph);
  if (earlier && earlier->graph != heading.graph)
    refuse(path_, "the folder holds the study of another graph, " + earlier->graph,
           "choose another folder with --out, or remove this one");
  if (resume) {
    if (earlier && earlier->key != heading.key)
      throw Error(Fault::graph, "the graph, its study or a plugin has changed since")
          .at((path_ / kJournalName).string())
          .hint("begin anew without --resume, or in another folder");
    return;
  }
  for (const std::string_view name : kOurs)
    if (name != kLock) fs::remove_all(path_ / name, failed);
}

void Folder::lock() {
  // The cells of a study that was killed share its lock and end a moment after it: what they were
  // writing must not meet what is written now.
  for (int waits = 0; !hold(); ++waits) {
    if (waits < kMostWaits) {
      std::this_thread::sleep_for(kWait);
      continue;
    }
    refuse(path_, "another process is writing to this folder",
           "wait for it, or choose another folder with --out");
  }
}

bool Folder::hold() {
  const fs::path file = path_ / kLock;
  lock_ = files::Descriptor(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666));
  if (!lock_)
    refuse(path_, "cannot be written: " + files::reason(errno), "choose another folder with --out");
  if (!files::lock_now(lock_.get())) return false;
  // A run that held it before has removed the file that was opened here.
  struct stat held = {};
  struct stat named = {};
  return ::fstat(lock_.get(), &held) == 0 && ::stat(file.c_str(), &named) == 0 &&
         held.st_ino == named.st_ino;
}

/// Without its heading nobody knows whose cells a journal has; they are not thrown away.
void Folder::refuse_damaged() const {
  const fs::path journal = path_ / kJournalName;
  std::error_code failed;
  const auto size = fs::file_size(journal, failed);
  if (failed || size == 0) return;
  std::size_t cells = 0;
  Journal::read(journal, 0, [&](const Cell&, const Outcome&) { ++cells; });
  if (cells > 0)
    refuse(journal,
           fmt::format("the heading is damaged; the outcomes of {} cells are there", cells),
           "choose another folder with --out, or remove this file to begin anew");
}

void Folder::refuse_strangers(bool ours, const std::string& graph) const {
  std::set<std::string> of_run;
  for (const fs::path& file : run::files_of_run(path_, graph))
    of_run.insert(file.begin()->string());
  const auto is_ours = [&](const fs::path& file) {
    const std::string name = file.filename().string();
    if (name == kLock || of_run.contains(name)) return true;
    // A study that was killed before it had begun leaves an empty journal.
    if (!ours) return name == kJournalName && fs::is_regular_file(file) && fs::is_empty(file);
    return std::ranges::find(kOurs, name) != kOurs.end();
  };
  for (const auto& entry : fs::directory_iterator(path_)) {
    const std::string name = entry.path().filename().string();
    const bool partial = name.starts_with(".") && name.find(".partial.") != std::string::npos;
    if (!partial && !is_ours(entry.path()))
      refuse(path_, "the folder holds what is not a result of a study: " + name,
             "choose another folder with --out");
  }
}

std::vector<std::string> names_of_study(const fs::path& folder, const std::string& graph) {
  const auto heading = Journal::heading_of(folder / kJournalName);
  if (!heading || heading->graph != graph) return {};
  // Not the lock, which runs use, too.
  return std::vector<std::string>(kOurs.begin(), kOurs.end() - 1);
}

}  // namespace velum::study
