// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Takes a table: for wires of outputs that may be missing.
#include <velum/stage.hpp>

namespace {

struct Count {
  static auto about() { return velum::About<Count>("Counts rows.").in("table").out("table"); }
  velum::Table operator()(const velum::Table& table, velum::Context& context) const {
    context.measure("rows", static_cast<double>(table.size()), "");
    return table;
  }
};

}  // namespace
VELUM_STAGE(Count)
