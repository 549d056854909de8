// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "velum/about.hpp"

namespace velum::graph {

/// The stages that a graph may name. Looking one up may open its plugin, and only that one.
class Catalog {
 public:
  Catalog() = default;
  Catalog(const Catalog&) = delete;
  Catalog& operator=(const Catalog&) = delete;
  virtual ~Catalog() = default;

  /// Null when the stage is unknown or its plugin cannot be loaded. Valid as long as the catalog.
  [[nodiscard]] virtual const StageInfo* find(std::string_view id) = 0;
  /// Why a plugin that exists cannot be loaded (Fault::plugin); empty when there is no such plugin.
  [[nodiscard]] virtual std::string why_not(std::string_view id) = 0;
  /// All known ids, sorted, without opening any plugin.
  [[nodiscard]] virtual std::vector<std::string> ids() = 0;
};

}  // namespace velum::graph
