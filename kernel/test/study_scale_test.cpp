// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <catch2/catch.hpp>
#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>

#include "folder.hpp"
#include "graph_support.hpp"
#include "study/journal.hpp"
#include "study/tables.hpp"

// What a study of 100,000 cells costs beside its cells: docs/scaling.md has the figures. Something
// that grows with the square of the cells would not end within the test's time.
using namespace velum::study;  // NOLINT: a test

namespace {

constexpr double kMegabyte = 1e6;

const std::string kGraph = R"(units = "mm"
[node.scan]
use = "devices.simulator"
[node.down]
use = "resampling.voxel_grid"
in = "scan"
size = 5
[node.mesh]
use = "meshing.delaunay_projected"
in = "down"
[study]
measure = ["mesh.holes", "mesh.rms", "mesh.seconds"]
)";

/// Prints the processor time that `work` takes and returns what it gives.
template <class Work>
auto timed(const char* what, const Work& work) {
  const std::clock_t began = std::clock();
  auto result = work();
  WARN(what << ": " << static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC << " s");
  return result;
}

/// As a cell could have ended; every hundredth has failed.
Outcome outcome(const Cell& cell) {
  Outcome made;
  made.source = "0123456789abcdef0123456789abcdef";
  if ((cell.variant + cell.repeat) % 100 == 0) {
    made.message = "mesh (meshing.delaunay_projected): nothing is left";
    return made;
  }
  made.status = Status::ok;
  made.seconds = 1.5;
  made.peak_bytes = 100'000'000;
  const auto v = static_cast<double>(cell.variant % 97);
  const auto r = static_cast<double>(cell.repeat);
  made.figures["mesh.holes"] = {v, "", velum::Better::lower};
  made.figures["mesh.rms"] = {1e-3 * (v + 0.01 * r * r), "m", velum::Better::lower};
  made.figures["mesh.seconds"] = {0.5 + 0.1 * r, "s", velum::Better::lower};
  return made;
}

void check_large(const std::string& study, std::size_t variants, std::size_t repeats) {
  auto loaded = velum::test::load_text(kGraph + study);
  INFO(velum::graph::format(loaded.diagnostics));
  REQUIRE(loaded.graph);
  const Plan plan = timed("planning", [&] { return make_plan(*loaded.graph->study); });
  REQUIRE(plan.variants.size() == variants);
  REQUIRE(plan.cells() == variants * repeats);

  const velum::test::Folder folder;
  const Journal::Heading heading{"/g.toml", "k"};
  timed("journal written", [&] {
    Journal journal(folder / "j", heading);
    for (std::size_t v = 0; v < variants; ++v)
      for (std::size_t r = 0; r < repeats; ++r) journal.add({v, r}, outcome({v, r}));
    journal.sync();
    return 0;
  });
  const auto journal =
      timed("journal read", [&] { return std::make_unique<Journal>(folder / "j", heading); });
  REQUIRE(journal->outcomes().size() == plan.cells());
  const Comparison comparison =
      timed("statistics", [&] { return compare(plan, journal->outcomes()); });
  CHECK(comparison.groups == 1);
  // One of those with another `a` than the reference, of which no cell failed.
  const auto& rms = comparison.variants[variants - 49].measures.at("mesh.rms");
  REQUIRE(rms.difference);
  CHECK(plan.label(plan.variants[rms.difference->reference], 0) == "1");
  const std::string rows =
      timed("study.csv", [&] { return csv(plan, journal->outcomes(), comparison); });
  const std::string all =
      timed("study.json", [&] { return json(plan, journal->outcomes(), comparison, "/g.toml"); });
  const std::string table = timed("table", [&] { return text(plan, comparison); });
  CHECK(static_cast<std::size_t>(std::count(rows.begin(), rows.end(), '\n')) == plan.cells() + 1);
  CHECK(table.size() < 10'000);
  const auto bytes = static_cast<double>(std::filesystem::file_size(folder / "j"));
  WARN("journal " << bytes / kMegabyte << " MB, csv "
                  << static_cast<double>(rows.size()) / kMegabyte << " MB, json "
                  << static_cast<double>(all.size()) / kMegabyte << " MB");
  CHECK(bytes < 600.0 * static_cast<double>(plan.cells()));
  CHECK(rows.size() < 150 * plan.cells());
  CHECK(all.size() < 250 * plan.cells() + 1500 * variants);
  CHECK(nlohmann::json::parse(all).at("variants").size() == variants);
}

}  // namespace

TEST_CASE("100,000 cells: 20,000 variants, five times each") {
  check_large(R"(repeat = 5
reference = { a = 1 }
[[study.vary]]
title = "a"
param = "down.size"
range = { from = 1, to = 200, steps = 200 }
[[study.vary]]
title = "b"
param = "mesh.max_edge"
range = { from = 1, to = 100, steps = 100 }
)",
              20'000, 5);
}

TEST_CASE("100,000 cells: as many variants, once each") {
  check_large(R"(reference = { a = 1 }
[[study.vary]]
title = "a"
param = "down.size"
range = { from = 1, to = 400, steps = 400 }
[[study.vary]]
title = "b"
param = "mesh.max_edge"
range = { from = 1, to = 250, steps = 250 }
)",
              100'000, 1);
}
