// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "plugins/registry.hpp"
#include "report/page.hpp"
#include "report/views.hpp"

namespace velum::report {

/// What describe tells of each of the stages, without their examples; those that are not there any
/// more are left out.
[[nodiscard]] run::Json describe_stages(const std::set<std::string>& ids,
                                        plugins::Registry& registry);

/// Leaves views.bin, so that the report can be made again, and report.html beside run.json.
void leave_run_report(const std::filesystem::path& folder, const Page& page, const Views& views,
                      plugins::Registry& registry);

/// What a page is headed with: the title, or the graph's file without its ending where it has none.
[[nodiscard]] std::string heading(const std::string& title, const std::string& graph);

/// Writes DIR/report.html from DIR/run.json and views of its values; where the page and the record
/// leave too little room, with fewer points. Throws Error.
void write_run_report(const std::filesystem::path& folder, const Page& page, Views views,
                      plugins::Registry& registry);

/// run.json of a folder as it is; throws Error (Fault::input) when it is none.
[[nodiscard]] run::Json read_record(const std::filesystem::path& file);

/// No report is larger [bytes].
inline constexpr std::uint64_t kMostBytes = 20'000'000;
/// The views with as many points as the page has room for besides `json`.
[[nodiscard]] Packed pack_within(Views views, const Page& page, const run::Json& json);

}  // namespace velum::report
