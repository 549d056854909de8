// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Many clouds to one; its second output is made on demand only.
#include <optional>
#include <velum/stage.hpp>

namespace {

struct Join {
  bool count = false;

  static auto about() {
    return velum::About<Join>("Merges clouds.")
        .in("clouds")
        .out("cloud")
        .out("table")
        .param(&Join::count, "count", "makes the table, too");
  }

  std::tuple<velum::Cloud, std::optional<velum::Table>> operator()(
      const std::vector<velum::Cloud>& clouds, velum::Context& context) const {
    for (const velum::Cloud& cloud : clouds)
      if (cloud.origin() != clouds.front().origin()) context.warn("several origins");
    std::optional<velum::Table> table;
    if (count) {
      table.emplace(std::vector<velum::Table::Heading>{{"points", ""}});
      for (const velum::Cloud& cloud : clouds) table->add({std::int64_t{cloud.size()}});
    }
    return {velum::merge(clouds), std::move(table)};
  }
};

}  // namespace
VELUM_STAGE(Join)
