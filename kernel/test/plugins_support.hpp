// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <catch2/catch.hpp>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include "error_of.hpp"
#include "plugins/call.hpp"
#include "plugins/entry.hpp"
#include "plugins/registry.hpp"
#include "velum/files.hpp"

/// What the tests of opening plugins share: those in bad_plugins/, whole and damaged.
namespace velum::test {

inline const std::filesystem::path kPlugins =
    std::filesystem::path(VELUM_BINARY_DIR) / "test-plugins";

/// A folder of its own for each test, with the user's cache in it.
class PluginFolder {
 public:
  PluginFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("velum-plugins-" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_ / "bad");
    ::setenv("XDG_CACHE_HOME", (path_ / "cache").c_str(), 1);
  }
  ~PluginFolder() { std::filesystem::remove_all(path_); }
  PluginFolder(const PluginFolder&) = delete;
  PluginFolder& operator=(const PluginFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::filesystem::path put(const std::string& name, std::string_view content) const {
    const std::filesystem::path file = path_ / "bad" / (name + ".so");
    std::ofstream(file, std::ios::binary) << content;
    return file;
  }
  [[nodiscard]] std::size_t remembered() const {
    const std::filesystem::path probes = path_ / "cache" / "velum" / "probes";
    if (!std::filesystem::exists(probes)) return 0;
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(probes), {}));
  }

 private:
  std::filesystem::path path_;
};

/// The bytes of a plugin in test-plugins/bad.
inline std::string content_of(const std::string& plugin) {
  return std::string(FileContent(kPlugins / "bad" / (plugin + ".so")).text());
}

/// Why the stage is refused.
inline Error refusal(const std::string& id, const std::filesystem::path& path = kPlugins) {
  plugins::Registry registry(plugins::Registry::Trust::probe, {path});
  Error error = error_of([&] { registry.stage(id); });
  // What the graph's check is told is the same.
  CHECK(registry.find(id) == nullptr);
  if (error.fault() == Fault::plugin) CHECK(registry.why_not(id) == plugins::one_line(error));
  return error;
}

/// Where the entry of `content` begins.
inline std::size_t entry_in(const std::string& content) {
  const auto at = content.find(std::string_view("VELUMPL1", 8));
  REQUIRE(at != std::string::npos);
  return at;
}

inline PluginEntry entry_of(const std::string& content) {
  PluginEntry entry;
  std::memcpy(&entry, content.data() + entry_in(content), sizeof(entry));
  return entry;
}

inline std::string with_entry(std::string content, const PluginEntry& entry) {
  std::memcpy(content.data() + entry_in(content), &entry, sizeof(entry));
  return content;
}

}  // namespace velum::test
