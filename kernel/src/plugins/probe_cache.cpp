// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// What earlier probes showed: one small JSON file a plugin in the user's cache folder. Each is
// written whole or not at all, so that processes may read and write them at once.
#include <sys/stat.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <span>

#include "plugins/probe.hpp"
#include "plugins/search.hpp"
#include "velum/error.hpp"
#include "velum/files.hpp"

namespace velum::plugins {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Size, time and inode: another content of the file has another stamp.
Json stamp(const fs::path& file) {
  struct stat status = {};
  if (::stat(file.c_str(), &status) != 0) return nullptr;
  return Json::array(
      {status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec, status.st_ino});
}

fs::path cache_folder() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
    return fs::path(value == nullptr ? "" : value);
  };
  const fs::path cache = variable("XDG_CACHE_HOME");
  if (cache.is_absolute()) return cache / "velum" / "probes";
  const fs::path home = variable("HOME");
  return home.is_absolute() ? home / ".cache" / "velum" / "probes" : fs::path();
}

fs::path cache_file(const fs::path& plugin) {
  const fs::path folder = cache_folder();
  if (folder.empty()) return {};
  const std::string name = fs::weakly_canonical(plugin).string();
  return folder / (hash_of(std::as_bytes(std::span(name))) + ".json");
}

std::string text(const Json& json, const char* key) {
  const auto at = json.find(key);
  return at != json.end() && at->is_string() ? at->get<std::string>() : "";
}

std::optional<Probed> remembered(const fs::path& cache, const Json& key) {
  std::error_code failed;
  if (cache.empty() || !fs::is_regular_file(cache, failed)) return std::nullopt;
  try {
    constexpr std::uint64_t kLimit = 1U << 20U;
    const Json json = Json::parse(FileContent(cache, kLimit).text(), nullptr, false);
    if (!json.is_object() || json.value("key", Json()) != key) return std::nullopt;
    return Probed{text(json, "quarantined"), "", text(json, "summary"), false};
  } catch (const Error&) {
    return std::nullopt;
  }
}

void remember(const fs::path& cache, const fs::path& plugin, const Json& key,
              const Probed& probed) {
  if (cache.empty()) return;
  const Json json = {{"plugin", plugin.string()},
                     {"key", key},
                     {"quarantined", probed.quarantined},
                     {"summary", probed.summary}};
  try {
    std::error_code failed;
    fs::create_directories(cache.parent_path(), failed);
    write_file(cache, json.dump(1, ' ', true, Json::error_handler_t::replace) + "\n");
  } catch (const Error&) {  // without a cache the next command probes again
  }
}

}  // namespace

Probed probe(const fs::path& file) {
  static const Json library = stamp(library_folder() / "libvelum.so");
  const Json key = {{"file", stamp(file)}, {"library", library}};
  const fs::path cache = cache_file(file);
  if (auto known = remembered(cache, key)) return *std::move(known);
  Probed probed = probe_afresh(file);
  if (probed.refused.empty() && !probed.uncertain) remember(cache, file, key, probed);
  return probed;
}

void forget_probe(const fs::path& file) {
  const fs::path cache = cache_file(file);
  std::error_code failed;
  if (!cache.empty()) fs::remove(cache, failed);
}

void require_sound(const std::filesystem::path& file) {
  const Probed probed = probe(file);
  if (probed.quarantined.empty()) return;
  throw Error(Fault::plugin, "the plugin is in quarantine: it " + probed.quarantined)
      .at(file.string())
      .hint("`velum list --quarantined` tries it again");
}

}  // namespace velum::plugins
