// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "run/cache.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "files/descriptor.hpp"
#include "files/hasher.hpp"
#include "files/lock.hpp"
#include "run/record.hpp"
#include "values/flat.hpp"
#include "velum/files.hpp"

namespace velum::run {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kEntryLimit = std::uint64_t{64} << 20U;
/// Trimming goes down to this share of the limit, so that it is not needed after every run.
constexpr double kTrimTo = 0.8;
/// Files of writers that were killed are removed when they are this old.
constexpr auto kStale = std::chrono::hours(24);

std::string checksum(std::string_view text) {
  return hash_of(std::as_bytes(std::span(text)));
}

void touch(const fs::path& file) {
  ::utimensat(AT_FDCWD, file.c_str(), nullptr, 0);
}

void discard(const fs::path& file) {
  std::error_code ignored;
  fs::remove(file, ignored);
}

Json to_json(const CacheEntry& entry) {
  return {{"parameters", entry.parameters},
          {"out", entry.out},
          {"measures", to_json(entry.measures)},
          {"warnings", entry.warnings}};
}

// The first line is the checksum of the rest.
CacheEntry parse(std::string_view text) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos || checksum(text.substr(end + 1)) != text.substr(0, end))
    throw Error(Fault::input, "the entry is damaged");
  const Json json = Json::parse(text.substr(end + 1));
  return {json.at("parameters"), json.at("out"), measures_from_json(json.at("measures")),
          json.at("warnings").get<std::vector<std::string>>()};
}

struct Stored {
  fs::file_time_type used;
  std::uint64_t bytes;
  fs::path file;
};

std::vector<Stored> stored_files(const fs::path& folder) {
  std::vector<Stored> files;
  std::error_code failed;
  for (auto entry = fs::recursive_directory_iterator(folder, failed);
       !failed && entry != fs::end(entry); entry.increment(failed)) {
    // Another process may remove the file while it is looked at.
    std::error_code gone;
    const bool regular = entry->is_regular_file(gone);
    const auto used = entry->last_write_time(gone);
    const auto bytes = entry->file_size(gone);
    if (!gone && regular) files.push_back({used, bytes, entry->path()});
  }
  return files;
}

bool is_partial(const Stored& stored) {
  return stored.file.filename().string().starts_with(".");
}

fs::path environment_path(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
  return value == nullptr ? "" : value;
}

}  // namespace

Cache::Cache(const fs::path& folder, std::uint64_t limit)
    : folder_(fs::absolute(folder)), limit_(limit) {}

fs::path Cache::entry_file(const std::string& key) const {
  return folder_ / "entries" / key.substr(0, 2) / (key + ".json");
}

fs::path Cache::values_file(const CacheEntry& entry) const {
  files::Hasher hasher;
  for (const auto& [name, summary] : entry.out.items())
    hasher.add(std::string_view(name + " " +
                                (summary.is_null() ? "" : summary.at("hash").get<std::string>())));
  const std::string content = hasher.hex();
  return folder_ / "values" / content.substr(0, 2) / (content + ".flat");
}

std::optional<CacheEntry> Cache::find(const std::string& key) const {
  const fs::path file = entry_file(key);
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) return std::nullopt;
  try {
    CacheEntry entry = parse(FileContent(file, kEntryLimit).text());
    const fs::path values = values_file(entry);
    if (!fs::is_regular_file(values, failed)) return std::nullopt;
    touch(file);
    touch(values);
    return entry;
  } catch (const Error&) {
    discard(file);
  } catch (const Json::exception&) {
    discard(file);
  }
  return std::nullopt;
}

std::optional<Results> Cache::load(const std::string& key, const CacheEntry& entry) const {
  const fs::path file = values_file(entry);
  try {
    return read_flat(file);
  } catch (const Error&) {
    discard(file);
    discard(entry_file(key));
    return std::nullopt;
  }
}

std::string Cache::store(const std::string& key, const CacheEntry& entry, const Results& results) {
  try {
    const fs::path values = values_file(entry);
    fs::create_directories(values.parent_path());
    if (!fs::exists(values)) {
      AtomicFile file(values);
      write_flat(file, results);
      file.commit();
    }
    const std::string text = dump(to_json(entry));
    const fs::path file = entry_file(key);
    fs::create_directories(file.parent_path());
    write_file(file, checksum(text) + "\n" + text);
    stored_ = true;
    return "";
  } catch (const Error& error) {
    return fmt::format("{}: {}", error.where(), error.what());
  } catch (const fs::filesystem_error& error) {
    return fmt::format("{}: {}", error.path1().string(), error.code().message());
  }
}

Cache::Claim Cache::claim(const std::string& key, const std::atomic<bool>* cancel) const {
  constexpr std::size_t kDigits = 3;  // 4096 files at most, shared by keys that begin alike
  // Short between the processes of one host; a file server shall not be asked by all its clients
  // all the time.
  std::chrono::milliseconds pause{5};
  constexpr std::chrono::milliseconds kLongestPause{160};
  std::error_code failed;
  fs::create_directories(folder_ / "claims", failed);
  const fs::path file = folder_ / "claims" / key.substr(0, kDigits);
  Claim claim{files::Descriptor(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666))};
  // Where there are no locks, or none between hosts, it is made twice: that is all.
  while (claim.lock && !files::lock_now(claim.lock.get()) && (cancel == nullptr || !*cancel)) {
    claim.waited = true;
    std::this_thread::sleep_for(pause);
    pause = std::min(kLongestPause, pause * 2);
  }
  return claim;
}

void Cache::trim() {
  if (!stored_) return;
  const files::Descriptor lock(
      ::open((folder_ / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (!lock || !files::lock_now(lock.get())) return;
  std::vector<Stored> files;
  for (const char* part : {"entries", "values"}) {
    std::vector<Stored> some = stored_files(folder_ / part);
    files.insert(files.end(), some.begin(), some.end());
  }
  std::sort(files.begin(), files.end(),
            [](const Stored& a, const Stored& b) { return a.used < b.used; });
  const auto stale = fs::file_time_type::clock::now() - kStale;
  std::uint64_t total = 0;
  for (const Stored& stored : files) total += stored.bytes;
  const bool full = total > limit_;
  const double wanted = kTrimTo * static_cast<double>(limit_);
  for (const Stored& stored : files) {
    const bool too_much = full && static_cast<double>(total) > wanted;
    if (is_partial(stored) ? stored.used > stale : !too_much) continue;
    discard(stored.file);
    total -= stored.bytes;
  }
}

fs::path default_cache_folder() {
  const fs::path cache = environment_path("XDG_CACHE_HOME");
  if (cache.is_absolute()) return cache / "velum" / "results";
  const fs::path home = environment_path("HOME");
  return home.is_absolute() ? home / ".cache" / "velum" / "results" : fs::path();
}

}  // namespace velum::run
