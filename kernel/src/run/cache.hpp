// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "files/descriptor.hpp"
#include "run/json.hpp"
#include "run/local_context.hpp"
#include "velum/stage.hpp"

namespace velum::run {

/// What the cache knows of a node's results without reading them.
struct CacheEntry {
  Json parameters = Json::object();  ///< as resolved
  Json out = Json::object();         ///< summaries by output; null: not made
  Measures measures;
  std::vector<std::string> warnings;
};

/// Results by their keys, in one folder that any number of processes may use at once.
///
/// An entry is a small JSON file with a checksum and, under the hash of its content, a file in the
/// flat format, so that results that are not needed are not read. Whatever is damaged is removed
/// and taken as not there; what cannot be written is not kept.
class Cache {
 public:
  static constexpr std::uint64_t kDefaultLimit = std::uint64_t{4} << 30U;

  explicit Cache(const std::filesystem::path& folder, std::uint64_t limit = kDefaultLimit);

  /// Marks the entry as used now.
  [[nodiscard]] std::optional<CacheEntry> find(const std::string& key) const;
  [[nodiscard]] std::optional<Results> load(const std::string& key, const CacheEntry& entry) const;
  /// The right to make what belongs to `key`, held until it is destroyed, so that processes that
  /// run side by side make it once. `waited`: another one has had it meanwhile, find() again.
  struct Claim {
    files::Descriptor lock;
    bool waited = false;
  };
  /// Waits for whoever holds it, unless `cancel` is set meanwhile.
  [[nodiscard]] Claim claim(const std::string& key, const std::atomic<bool>* cancel) const;
  /// Returns why the results could not be kept; "" when they are.
  std::string store(const std::string& key, const CacheEntry& entry, const Results& results);
  /// Removes what was not used for longest until the folder is within its limit. Does nothing when
  /// nothing was stored by this process, or when another one is at it.
  void trim();

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  [[nodiscard]] std::filesystem::path entry_file(const std::string& key) const;
  [[nodiscard]] std::filesystem::path values_file(const CacheEntry& entry) const;

  std::filesystem::path folder_;
  std::uint64_t limit_;
  std::atomic<bool> stored_{false};
};

/// $XDG_CACHE_HOME/velum/results or ~/.cache/velum/results; empty when there is neither.
std::filesystem::path default_cache_folder();

}  // namespace velum::run
