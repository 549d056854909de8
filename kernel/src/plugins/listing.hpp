// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "plugins/search.hpp"

namespace velum::plugins {

/// One stage on the plugin path.
struct Listed {
  std::string id;
  Files files;  ///< the one that counts, then those that it hides
  std::string summary;
  std::string refused;  ///< why it cannot be loaded; else empty
};

/// The stages of `kind` (all when it is empty) by id. Opens no plugin in this process: what they
/// say of themselves comes from probes. `again` tries those anew that are in quarantine.
std::vector<Listed> list_plugins(const std::vector<std::filesystem::path>& path,
                                 const std::string& kind, bool again = false);

}  // namespace velum::plugins
