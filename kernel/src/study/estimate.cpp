// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "run/json.hpp"
#include "run/local_context.hpp"
#include "run/output_folder.hpp"
#include "study/journal.hpp"
#include "velum/error.hpp"
#include "velum/files.hpp"

namespace velum::study {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargest = std::uint64_t{1} << 30U;

/// Mean time of a cell of the study that is in the folder.
std::optional<double> of_study(const fs::path& folder, const std::string& graph) {
  const fs::path file = folder / kJournalName;
  const auto heading = Journal::heading_of(file);
  if (!heading || heading->graph != graph) return std::nullopt;
  double seconds = 0.0;
  std::size_t cells = 0;
  Journal::read(file, 0, [&](const Cell&, const Outcome& outcome) {
    seconds += outcome.seconds;
    ++cells;
  });
  if (cells == 0) return std::nullopt;
  return seconds / static_cast<double>(cells);
}

/// Time of the run that is there.
std::optional<double> of_run(const fs::path& folder, const std::string& graph) {
  const fs::path file = folder / run::kRecordName;
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) return std::nullopt;
  const auto json = run::Json::parse(FileContent(file, kLargest).text(), nullptr, false);
  try {
    if (json.at("graph").at("path").get<std::string>() != graph || json.at("status") != "ok")
      return std::nullopt;
    return json.at("seconds").get<double>();
  } catch (const run::Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace

std::string outlook(const Plan& plan, const fs::path& folder, const std::string& graph, int jobs) {
  const std::string count = fmt::format("{} variants x {} repeats = {} cells", plan.variants.size(),
                                        plan.study.seeds.size(), plan.cells());
  auto each = of_study(folder, graph);
  const char* source = "the cells of the study before";
  if (!each) {
    each = of_run(folder, graph);
    source = "the run before";
  }
  if (!each) return count + "; no earlier run or study of the graph tells how long they take";
  const int at_once = plan.study.exclusive ? 1 : jobs > 0 ? jobs : run::default_threads();
  const auto rounds = std::ceil(static_cast<double>(plan.cells()) / at_once);
  return fmt::format("{}, about {} with {} at a time, if they take as long as {}", count,
                     rough_time(rounds * *each), at_once, source);
}

std::string rough_time(double seconds) {
  constexpr double kMinute = 60.0;
  constexpr double kHour = 3600.0;
  if (seconds < 2.0 * kMinute) return fmt::format("{:.0f} s", std::max(1.0, seconds));
  if (seconds < 2.0 * kHour) return fmt::format("{:.0f} min", seconds / kMinute);
  return fmt::format("{:.1f} h", seconds / kHour);
}

}  // namespace velum::study
