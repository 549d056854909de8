// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Any bytes as a graph: parsed, checked, and either refused with messages that can be shown or
// taken, and then its resolved text must be the same graph.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "fake_catalog.hpp"
#include "graph/graph.hpp"

namespace {

constexpr const char* kName = "/nonexistent/fuzz.toml";

void require(bool good) {
  if (!good) std::abort();
}

void check_messages(const velum::graph::Loaded& loaded) {
  for (const auto& diagnostic : loaded.diagnostics) {
    require(diagnostic.code.size() == 5 && !diagnostic.message.empty());
    require(!velum::graph::format(diagnostic).empty());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fake::Catalog catalog;
  const std::string text(reinterpret_cast<const char*>(data), size);  // NOLINT
  const auto loaded = velum::graph::load_text(text, kName, {}, catalog);
  check_messages(loaded);
  require(loaded.graph.has_value() == loaded.diagnostics.empty());
  if (!loaded.graph) return 0;
  const auto again = velum::graph::load_text(loaded.graph->resolved, kName, {}, catalog);
  require(again.graph && again.graph->resolved == loaded.graph->resolved);
  return 0;
}
