// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "study/tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "run/record.hpp"

namespace velum::study {
namespace {

/// A field of a CSV file (RFC 4180).
std::string field(std::string text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  for (std::size_t at = text.find('"'); at != std::string::npos; at = text.find('"', at + 2))
    text.insert(at, 1, '"');
  return "\"" + text + "\"";
}

std::string heading(const std::string& name, const Figure& measure) {
  return measure.unit.empty() ? name : fmt::format("{} [{}]", name, measure.unit);
}

/// The study's measures, in the order in which it names them.
std::vector<std::string> measured(const Plan& plan) {
  std::vector<std::string> names;
  for (const auto& measure : plan.study.measures) names.push_back(measure.full());
  return names;
}

run::Json axes_of(const Plan& plan, const Variant& variant) {
  run::Json axes = run::Json::object();
  for (std::size_t a = 0; a < plan.study.axes.size(); ++a)
    axes[plan.study.axes[a].name] = plan.label(variant, a);
  return axes;
}

run::Json runs_of(const Plan& plan, const Outcomes& outcomes, std::size_t variant) {
  run::Json runs = run::Json::array();
  for (std::size_t r = 0; r < plan.study.seeds.size(); ++r) {
    const Outcome& outcome = outcomes.at({variant, r});
    run::Json measures = run::Json::object();
    for (const auto& [name, figure] : outcome.figures) measures[name] = figure.value;
    run::Json run = {{"repeat", r + 1},
                     {"seed", plan.study.seeds[r]},
                     {"status", name_of(outcome.status)},
                     {"measures", std::move(measures)}};
    if (!outcome.message.empty()) run["message"] = outcome.message;
    runs.push_back(std::move(run));
  }
  return runs;
}

run::Json summary_of(const Plan& plan, const VariantSummary& variant) {
  run::Json all = run::Json::object();
  for (const auto& [name, measure] : variant.measures) {
    const Summary& s = measure.summary;
    run::Json& one = all[name];
    one = {{"count", measure.count},
           {"mean", s.mean},
           {"sd", s.sd},
           {"median", s.median},
           {"q1", s.q1},
           {"q3", s.q3},
           {"ci95", {s.ci95.first, s.ci95.second}},
           {"rank", run::or_null(measure.rank)}};
    if (measure.difference)
      one["difference"] = {{"reference", plan.variants[measure.difference->reference].id},
                           {"pairs", measure.difference->pairs},
                           {"mean", measure.difference->mean},
                           {"p", run::or_null(measure.difference->p)}};
  }
  return all;
}

/// Columns as wide as their widest entry; numbers to the right.
std::string aligned(const std::vector<std::vector<std::string>>& rows, std::size_t left) {
  const auto width_of = [](const std::string& text) {
    return static_cast<std::size_t>(std::ranges::count_if(
        text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
  };
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width_of(row[c]));
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string blanks(widths[c] - width_of(row[c]), ' ');
      line += (c > 0 ? "  " : "") + (c < left ? row[c] + blanks : blanks + row[c]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string mean_and_sd(const MeasureSummary& measure) {
  std::string text = fmt::format("{:.4g}", measure.summary.mean);
  if (measure.count > 1) text += fmt::format(" ±{:.2g}", measure.summary.sd);
  // A difference from the reference that is more than chance.
  if (measure.difference && measure.difference->p && *measure.difference->p < 0.05) text += " *";
  return text;
}

/// Variants by the rank in the first measure, those without a rank last; groups stay together.
std::vector<std::size_t> best_first(const Comparison& comparison, const std::string& measure) {
  std::vector<std::size_t> order(comparison.variants.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t v) {
    const VariantSummary& variant = comparison.variants[v];
    const auto found = variant.measures.find(measure);
    const bool ranked = found != variant.measures.end() && found->second.rank;
    return std::tuple(variant.group, !ranked, ranked ? *found->second.rank : 0);
  });
  return order;
}

constexpr std::size_t kMostRows = 40;

}  // namespace

std::string csv(const Plan& plan, const Outcomes& outcomes, const Comparison& comparison) {
  const std::vector<std::string> names = measured(plan);
  std::string text = "variant,repeat,seed,status,message";
  std::set<std::string> columns;
  for (const auto& axis : plan.study.axes) {
    text += "," + field(axis.name);
    columns.insert(axis.name);
  }
  for (const std::string& name : names) {
    std::string column = heading(name, comparison.measures.at(name));
    if (!columns.insert(column).second) column += " []";  // an axis has that name
    text += "," + field(column);
  }
  text += "\n";
  for (std::size_t v = 0; v < plan.variants.size(); ++v) {
    for (std::size_t r = 0; r < plan.study.seeds.size(); ++r) {
      const Outcome& outcome = outcomes.at({v, r});
      text += fmt::format("{},{},{},{},{}", plan.variants[v].id, r + 1, plan.study.seeds[r],
                          name_of(outcome.status), field(outcome.message));
      for (std::size_t a = 0; a < plan.study.axes.size(); ++a)
        text += "," + field(plan.label(plan.variants[v], a));
      for (const std::string& name : names) {
        const auto found = outcome.figures.find(name);
        text += found == outcome.figures.end() ? "," : fmt::format(",{}", found->second.value);
      }
      text += "\n";
    }
  }
  return text;
}

std::string json(const Plan& plan, const Outcomes& outcomes, const Comparison& comparison,
                 const std::string& graph) {
  run::Json axes = run::Json::array();
  for (const auto& axis : plan.study.axes) {
    run::Json labels = run::Json::array();
    for (const auto& choice : axis.choices) labels.push_back(choice.label);
    axes.push_back({{"name", axis.name}, {"values", std::move(labels)}});
  }
  run::Json measures = run::Json::object();
  for (const std::string& name : measured(plan)) {
    const Figure& figure = comparison.measures.at(name);
    measures[name] = {{"unit", figure.unit}, {"better", run::name_of(figure.better)}};
  }
  const run::Json head = {{"velum", kVersion},
                          {"graph", graph},
                          {"title", plan.study.title},
                          {"axes", std::move(axes)},
                          {"measures", std::move(measures)}};
  // All variants of a large study as one value would take gigabytes.
  std::string text = run::dump(head);
  text.pop_back();
  text += ",\"variants\":[";
  for (std::size_t v = 0; v < plan.variants.size(); ++v) {
    const VariantSummary& summary = comparison.variants[v];
    const run::Json variant = {
        {"id", plan.variants[v].id},          {"axes", axes_of(plan, plan.variants[v])},
        {"status", name_of(summary.status)},  {"message", summary.message},
        {"success", summary.success},         {"data", summary.group},
        {"runs", runs_of(plan, outcomes, v)}, {"summary", summary_of(plan, summary)}};
    text += (v > 0 ? ",\n" : "\n") + run::dump(variant);
  }
  return text + "\n]}\n";
}

std::string text(const Plan& plan, const Comparison& comparison) {
  const std::vector<std::string> names = measured(plan);
  std::vector<std::string> head = {"variant"};
  for (const auto& axis : plan.study.axes) head.push_back(axis.name);
  const std::size_t left = head.size();
  head.emplace_back("ok");
  for (const std::string& name : names) head.push_back(heading(name, comparison.measures.at(name)));
  head.emplace_back("");
  std::vector<std::vector<std::string>> rows = {head};
  const auto order = best_first(comparison, names.empty() ? "" : names.front());
  for (const std::size_t v : order) {
    if (rows.size() > kMostRows) break;
    const VariantSummary& summary = comparison.variants[v];
    std::vector<std::string> row = {plan.variants[v].id};
    for (std::size_t a = 0; a < plan.study.axes.size(); ++a)
      row.push_back(plan.label(plan.variants[v], a));
    row.push_back(fmt::format("{:.0f} %", 100.0 * summary.success));
    for (const std::string& name : names) {
      const auto found = summary.measures.find(name);
      row.push_back(found == summary.measures.end() ? "-" : mean_and_sd(found->second));
    }
    row.push_back(summary.status == Status::ok ? "" : std::string(name_of(summary.status)));
    rows.push_back(std::move(row));
  }
  std::string table = aligned(rows, left);
  if (order.size() > kMostRows) table += fmt::format("and {} more\n", order.size() - kMostRows);
  if (comparison.groups > 1)
    table += "Not all variants had the same data: ranks count those that had.\n";
  return table;
}

}  // namespace velum::study
