// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "report/study_report.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "report/run_report.hpp"
#include "report/views_file.hpp"
#include "report/watch.hpp"
#include "run/output_folder.hpp"
#include "velum/files.hpp"

namespace velum::report {
namespace {

namespace fs = std::filesystem;
using run::Json;

/// Variants that are told, the best ones of a larger study; study.csv has all of them.
constexpr std::size_t kMostTold = 2'000;
/// Cells that are told one by one; of more, only the statistics of each variant.
constexpr std::size_t kMostCells = 20'000;
/// Of study.csv within the page [bytes].
constexpr std::uint64_t kMostTable = 4'000'000;

Json read_study(const fs::path& file) {
  const FileContent content(file);
  try {
    Json study = Json::parse(content.text());
    for (const char* key : {"velum", "title", "axes", "measures", "variants"})
      static_cast<void>(study.at(key));
    return study;
  } catch (const Json::exception& error) {
    throw Error(Fault::input, std::string("not the results of a study: ") + error.what())
        .at(file.string());
  }
}

/// The views that the first of the variant's cells that is ok has left.
std::optional<std::vector<View>> views_of(const fs::path& folder, const Json& variant,
                                          std::set<std::string>& stages) {
  const fs::path cells = folder / "cells" / variant.at("id").get<std::string>();
  for (const Json& run : variant.at("runs")) {
    if (run.at("status") != "ok") continue;
    const fs::path cell = cells / std::to_string(run.at("repeat").get<std::uint64_t>());
    try {
      // Without its record a cell is somebody's folder.
      const FileContent record(cell / run::kRecordName);
      ViewsFile content = read_views(cell / run::kViewsName);
      if (content.record != hash_of(record.bytes())) continue;
      const Json told = Json::parse(record.text());
      for (const Json& node : told.at("nodes")) stages.insert(node.at("use").get<std::string>());
      return std::move(content.views);
    } catch (const Error&) {  // removed or damaged: the next repeat may do
    } catch (const Json::exception&) {
    }
  }
  return std::nullopt;
}

/// What tells one value from another, by node and output.
struct Content {
  Bytes::Key positions;
  Bytes::Key triangles;
  std::vector<Bytes::Key> columns;
  bool operator==(const Content&) const = default;
};
Content content_of(const View& view) {
  Content content{view.positions.key(), view.triangles.key(), {}};
  for (const ViewColumn& column : view.columns) content.columns.push_back(column.data.key());
  return content;
}

/// What does not vary, such as the truth, is told once: the histograms of later variants go.
void drop_repeated_histograms(std::vector<std::vector<View>>& variants) {
  std::map<std::string, Content> first;
  std::set<std::string> varies;
  for (const auto& views : variants)
    for (const View& view : views) {
      const std::string name = view.node + "." + view.output;
      const auto [known, fresh] = first.emplace(name, content_of(view));
      if (!fresh && !(known->second == content_of(view))) varies.insert(name);
    }
  std::set<std::string> told;
  for (auto& views : variants)
    for (View& view : views) {
      const std::string name = view.node + "." + view.output;
      if (!told.insert(name).second && !varies.contains(name)) view.histograms.clear();
    }
}

struct Shown {
  Views views{kRunLimit};
  std::set<std::string> stages;
  std::size_t variants = 0;
};

Shown shown(const fs::path& folder, const Json& study) {
  constexpr std::size_t kMostValues = 4096;  // of one variant
  Shown found;
  std::vector<std::vector<View>> variants;
  const Json& told = study.at("variants");
  for (std::size_t i = 0; i < std::min(told.size(), kMostVariants); ++i) {
    auto views = views_of(folder, told.at(i), found.stages);
    if (!views) continue;
    for (View& view : *views) {
      view.variant = told.at(i).at("id").get<std::string>();
      view.order += i * kMostValues;
    }
    variants.push_back(std::move(*views));
  }
  found.variants = variants.size();
  drop_repeated_histograms(variants);
  for (auto& views : variants)
    for (View& view : views) found.views.add(std::move(view));
  return found;
}

std::size_t cells_of(const Json& study) {
  std::size_t cells = 0;
  for (const Json& variant : study.at("variants")) cells += variant.at("runs").size();
  return cells;
}

/// The variants with the best ranks in the first measure, in the study's order.
Json best_of(const Json& study) {
  const Json& variants = study.at("variants");
  const std::string measure =
      study.at("measures").empty() ? "" : study.at("measures").begin().key();
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const Json& summary = variants.at(i).at("summary");
    const auto found = summary.find(measure);
    const bool ranked = found != summary.end() && !found->at("rank").is_null();
    order.emplace_back(ranked ? found->at("rank").get<std::uint64_t>() : variants.size() + 1, i);
  }
  std::ranges::sort(order);
  order.resize(std::min(order.size(), kMostTold));
  std::ranges::sort(order, {}, [](const auto& each) { return each.second; });
  Json best = Json::array();
  for (const auto& [rank, i] : order) best.push_back(variants.at(i));
  return best;
}

/// A page with all of a very large study would be too heavy to open.
Json told(Json study) {
  if (study.at("variants").size() > kMostTold) study["variants"] = best_of(study);
  if (cells_of(study) > kMostCells)
    for (Json& variant : study.at("variants")) variant.erase("runs");
  return study;
}

}  // namespace

void write_study_report(const fs::path& folder, const Page& page, plugins::Registry& registry) {
  Json study = read_study(folder / kStudyName);
  Json json = {{"format", 1}, {"kind", "study"}};
  try {
    json["velum"] = study.at("velum");
    json["title"] = heading(study.at("title").get<std::string>(), study.value("graph", ""));
    Shown found = shown(folder, study);
    json["stages"] = describe_stages(found.stages, registry);
    const std::size_t variants = study.at("variants").size();
    json["views_of"] = {{"variants", found.variants}, {"of", variants}};
    json["study"] = told(std::move(study));
    json["told"] = {{"variants", json["study"].at("variants").size()}, {"of", variants}};
    const FileContent table(folder / kStudyTableName);
    if (table.size() <= kMostTable) json["csv"] = table.text();
    Packed packed = pack_within(std::move(found.views), page, json);
    json["values"] = std::move(packed.values);
    json["histograms"] = std::move(packed.histograms);
    page.write(folder / run::kReportName, json, packed.block);
  } catch (const Json::exception& error) {
    throw Error(Fault::input, std::string("not the results of a study: ") + error.what())
        .at((folder / kStudyName).string());
  }
}

}  // namespace velum::report
