// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "run/output_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <sstream>

#include "files/lock.hpp"
#include "run/json.hpp"
#include "velum/files.hpp"

namespace velum::run {
namespace {

namespace fs = std::filesystem;

/// Holds the process's number, the graph and the files to come, a line each.
constexpr const char* kLockName = ".velum.lock";
constexpr const char* kScratchName = ".velum.scratch";
constexpr std::uint64_t kRecordLimit = std::uint64_t{1} << 30U;

[[noreturn]] void refuse(const fs::path& path, const std::string& message,
                         const std::string& hint) {
  throw Error(Fault::output, message).at(path.string()).hint(hint);
}

// What a run left: the graph, and the files that are its own.
struct Earlier {
  std::string graph;
  std::vector<std::string> files;
};

std::optional<Earlier> from_record(const fs::path& file) {
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) return std::nullopt;
  try {
    const Json json = Json::parse(FileContent(file, kRecordLimit).text());
    Earlier earlier{json.at("graph").at("path").get<std::string>(),
                    {kRecordName, kReportName, kViewsName}};
    for (const Json& entry : json.at("files"))
      earlier.files.push_back(entry.at("path").get<std::string>());
    return earlier;
  } catch (const Json::exception&) {
    return std::nullopt;  // some other run.json
  }
}

std::optional<Earlier> from_lock(const fs::path& file) {
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) return std::nullopt;
  std::istringstream lines{std::string(FileContent(file, kRecordLimit).text())};
  std::string line;
  Earlier earlier;
  if (!std::getline(lines, line) || !std::getline(lines, earlier.graph)) return std::nullopt;
  while (std::getline(lines, line)) earlier.files.push_back(line);
  return earlier;
}

// A name in a record could lead anywhere: only files below the folder are ever ours.
bool stays_inside(const fs::path& relative) {
  return relative.is_relative() && !relative.empty() &&
         std::none_of(relative.begin(), relative.end(),
                      [](const fs::path& p) { return p == ".."; });
}

bool is_partial(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with(".") && name.find(".partial.") != std::string::npos;
}

}  // namespace

std::vector<fs::path> files_of_run(const fs::path& folder, const std::string& graph) {
  std::vector<fs::path> files;
  for (const auto& earlier : {from_record(folder / kRecordName), from_lock(folder / kLockName)}) {
    if (!earlier) continue;
    // A record can only hold a name that is UTF-8.
    if (earlier->graph != graph &&
        earlier->graph != Json::parse(dump(Json(graph))).get<std::string>())
      refuse(folder,
             fmt::format("the folder holds the results of another graph, {}", earlier->graph),
             "choose another folder with --out, or remove this one");
    for (const std::string& name : earlier->files)
      if (const fs::path file = fs::path(name).lexically_normal(); stays_inside(file))
        files.push_back(file);
  }
  return files;
}

OutputFolder::OutputFolder(const fs::path& path, const std::string& graph,
                           const std::vector<std::string>& files,
                           const std::vector<std::string>& others)
    : others_(others.begin(), others.end()) {
  std::error_code failed;
  path_ = fs::absolute(path).lexically_normal();
  fs::create_directories(path_, failed);
  if (!fs::is_directory(path_))
    refuse(path_, failed ? "the folder cannot be made: " + failed.message() : "not a folder",
           "choose another folder with --out");
  path_ = fs::canonical(path_);
  lock();
  try {
    refuse_strangers(graph);
  } catch (...) {
    // The folder stays as it was: a lock that names files of a killed run is still of use.
    std::error_code unknown;
    if (fs::file_size(path_ / kLockName, unknown) == 0) fs::remove(path_ / kLockName, unknown);
    throw;
  }
  note(graph, files);
  remove_earlier();
}

OutputFolder::~OutputFolder() {
  close();
}

void OutputFolder::lock() {
  const fs::path file = path_ / kLockName;
  while (true) {
    lock_ =
        files::Descriptor(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666));
    if (!lock_)
      refuse(path_, "cannot be written: " + files::reason(errno),
             "choose another folder with --out");
    if (!files::lock_now(lock_.get())) {
      std::string process(32, '\0');
      const ssize_t got = ::pread(lock_.get(), process.data(), process.size(), 0);
      process.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
      process.resize(std::min(process.find('\n'), process.size()));
      refuse(path_,
             process.empty() ? "another process is writing to this folder"
                             : fmt::format("process {} is writing to this folder", process),
             "wait for it, or choose another folder with --out");
    }
    // The one who held it before may have removed the file that was opened here.
    struct stat held = {};
    struct stat named = {};
    if (::fstat(lock_.get(), &held) == 0 && ::stat(file.c_str(), &named) == 0 &&
        held.st_ino == named.st_ino)
      return;
  }
}

void OutputFolder::refuse_strangers(const std::string& graph) {
  earlier_ = files_of_run(path_, graph);
  std::erase_if(earlier_, [&](const fs::path& file) { return others_.contains(*file.begin()); });
  std::set<fs::path> ours = {kLockName};
  for (const fs::path& file : earlier_)
    for (fs::path part = file; !part.empty(); part = part.parent_path()) ours.insert(part);
  std::string strangers;
  int count = 0;
  for (auto entry = fs::recursive_directory_iterator(path_); entry != fs::end(entry); ++entry) {
    const fs::path relative = entry->path().lexically_relative(path_);
    const bool left_alone = relative == kScratchName || others_.contains(relative);
    if (left_alone) entry.disable_recursion_pending();
    if (left_alone || ours.contains(relative) || is_partial(relative)) continue;
    if (entry->is_directory()) entry.disable_recursion_pending();
    if (++count <= 3) strangers += (count > 1 ? ", " : "") + relative.string();
  }
  if (count > 3) strangers += fmt::format(" and {} more", count - 3);
  if (count > 0)
    refuse(path_, "the folder holds what is not a result of this graph: " + strangers,
           "choose another folder with --out");
}

void OutputFolder::remove_earlier() {
  std::error_code ignored;
  for (const fs::path& file : earlier_) {
    if (!fs::is_directory(fs::symlink_status(path_ / file, ignored)))
      fs::remove(path_ / file, ignored);
    // Folders that are empty now; the system refuses to remove others.
    for (fs::path part = file.parent_path(); !part.empty(); part = part.parent_path())
      fs::remove(path_ / part, ignored);
  }
  fs::remove_all(path_ / kScratchName, ignored);
}

// Before anything is removed, so that whenever this run is killed the next one knows what is ours.
void OutputFolder::note(const std::string& graph, const std::vector<std::string>& files) {
  std::string text =
      fmt::format("{}\n{}\n{}\n{}\n{}\n", ::getpid(), graph, kRecordName, kReportName, kViewsName);
  for (const std::string& file : files) text += file + "\n";
  for (const fs::path& file : earlier_) text += file.string() + "\n";
  try {
    files::write_fully(lock_.get(), std::as_bytes(std::span(text)));
    if (::ftruncate(lock_.get(), static_cast<off_t>(text.size())) != 0)
      throw std::system_error(errno, std::generic_category());
  } catch (const std::system_error& error) {
    refuse(path_, "cannot be written: " + files::reason(error.code().value()), "");
  }
}

fs::path OutputFolder::scratch() const {
  std::error_code failed;
  fs::path folder = path_ / kScratchName;
  fs::create_directory(folder, failed);
  if (failed) refuse(folder, "the folder cannot be made: " + failed.message(), "");
  return folder;
}

void OutputFolder::close() {
  if (!lock_) return;
  std::error_code ignored;
  fs::remove_all(path_ / kScratchName, ignored);
  const std::string own = fmt::format(".partial.{}", ::getpid());
  for (auto entry = fs::recursive_directory_iterator(path_, ignored); entry != fs::end(entry);
       entry.increment(ignored)) {
    const fs::path& file = entry->path();
    if (others_.contains(file.lexically_relative(path_))) entry.disable_recursion_pending();
    if (is_partial(file) && file.string().find(own) != std::string::npos) fs::remove(file, ignored);
  }
  fs::remove(path_ / kLockName, ignored);
  lock_ = files::Descriptor();
}

}  // namespace velum::run
