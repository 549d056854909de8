// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "report/run_report.hpp"

#include <algorithm>

#include "plugins/describe.hpp"
#include "report/views_file.hpp"
#include "run/output_folder.hpp"
#include "run/record_file.hpp"
#include "velum/files.hpp"

namespace velum::report {
namespace {

/// Of arrays that are shown even when page and record alone are too large.
constexpr std::uint64_t kLeast = 1'000'000;
/// Of all tables together: some 4 MB of JSON.
constexpr std::size_t kMostCells = 200'000;

std::uint64_t base64_size(std::uint64_t bytes) {
  return (bytes + 2) / 3 * 4;
}

}  // namespace

run::Json describe_stages(const std::set<std::string>& ids, plugins::Registry& registry) {
  run::Json stages = run::Json::object();
  for (const std::string& id : ids) {
    const StageInfo* info = registry.find(id);
    if (info == nullptr) continue;
    stages[id] = plugins::describe_json(*info, "");
    stages[id].erase("example");
  }
  return stages;
}

Packed pack_within(Views views, const Page& page, const run::Json& json) {
  const std::uint64_t fixed = page.size() + script_json(json).size();
  while (true) {
    std::vector<View> shown = views.all();
    limit_tables(shown, kMostCells);
    Packed packed = pack(shown);
    const std::uint64_t said =
        script_json(packed.values).size() + script_json(packed.histograms).size();
    const std::uint64_t room = kMostBytes - std::min(kMostBytes, fixed + said);
    const std::uint64_t bytes = std::max(kLeast, room / 4 * 3);
    if (base64_size(packed.block.size()) <= room || packed.block.size() <= kLeast) return packed;
    const std::uint64_t before = views.bytes();
    views.limit_to(std::min(bytes, before - before / 64));
    if (views.bytes() == before) return packed;
  }
}

std::string heading(const std::string& title, const std::string& graph) {
  return title.empty() ? std::filesystem::path(graph).stem().string() : title;
}

void leave_run_report(const std::filesystem::path& folder, const Page& page, const Views& views,
                      plugins::Registry& registry) {
  const std::string record = hash_of(FileContent(folder / run::kRecordName).bytes());
  write_views(folder / run::kViewsName, {record, views.all()});
  write_run_report(folder, page, views, registry);
}

void write_run_report(const std::filesystem::path& folder, const Page& page, Views views,
                      plugins::Registry& registry) {
  run::Json record = read_record(folder / run::kRecordName);
  std::set<std::string> stages;
  for (const run::Json& node : record.at("nodes")) stages.insert(node.at("use").get<std::string>());
  run::Json json = {{"format", 1}, {"kind", "run"}};
  json["velum"] = record.at("velum");
  json["title"] = heading(record.at("graph").at("title").get<std::string>(),
                          record.at("graph").at("path").get<std::string>());
  json["run"] = std::move(record);
  json["stages"] = describe_stages(stages, registry);
  Packed packed = pack_within(std::move(views), page, json);
  json["values"] = std::move(packed.values);
  json["histograms"] = std::move(packed.histograms);
  page.write(folder / run::kReportName, json, packed.block);
}

run::Json read_record(const std::filesystem::path& file) {
  return run::read_record(file, {"velum", "graph.title", "nodes"});
}

}  // namespace velum::report
