// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "graph/catalog.hpp"
#include "plugins/search.hpp"
#include "velum/stage.hpp"

namespace velum::plugins {

/// The stages on the plugin path; each plugin is opened when its stage is first asked for.
/// Thread-safe.
class Registry final : public graph::Catalog {
 public:
  /// What happens to a plugin before it is first opened in this process.
  enum class Trust {
    probe,  ///< files not seen before are tried in a child process
    open,   ///< opened at once: for tests of one's own plugins
  };

  explicit Registry(Trust trust = Trust::probe,
                    std::vector<std::filesystem::path> path = search_path());

  const StageInfo* find(std::string_view id) override;
  std::string why_not(std::string_view id) override;
  std::vector<std::string> ids() override;

  /// Throws Error: Fault::graph when there is no such plugin, Fault::plugin when it cannot be
  /// loaded.
  const StageType& stage(std::string_view id);
  /// The plugin's file; throws Error (Fault::graph) when there is none.
  std::filesystem::path file(std::string_view id);
  /// XXH3-128 of the plugin's file.
  std::string file_hash(std::string_view id);
  [[nodiscard]] const std::vector<std::filesystem::path>& path() const { return path_; }

 private:
  struct Slot {
    const StageType* stage = nullptr;
    std::optional<Error> failed;
  };
  const Slot& slot(std::string_view id);
  Slot open(std::string_view id) const;
  [[nodiscard]] Error unknown(std::string_view id) const;

  Trust trust_;
  std::vector<std::filesystem::path> path_;
  std::mutex mutex_;
  std::map<std::string, Slot, std::less<>> slots_;
};

/// An error in one line: message, place and hint.
std::string one_line(const Error& error);

}  // namespace velum::plugins
