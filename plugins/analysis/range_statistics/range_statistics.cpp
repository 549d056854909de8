// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <velum/stage.hpp>

#include "metrology/distribution.hpp"
#include "metrology/trend.hpp"
#include "readings.hpp"

namespace {

using velum::Table;
using velum::metrology::Moments;
using velum::metrology::Trend;

constexpr double kMillimetre = 1e3;
constexpr double kHour = 3600.0;
constexpr double kMostBins = 100'000;

std::string name_of(Per per) {
  switch (per) {
    case Per::beam:
      return "beam";
    case Per::label:
      return "label";
    case Per::period:
      return "period";
    case Per::all:
      break;
  }
  return "group";
}

struct RangeStatistics {
  Per per = Per::all;
  velum::Duration period{kHour};
  std::vector<int> beams;
  bool perpendicular = false;
  std::vector<int> labels;
  velum::Length nearest{0.0};
  velum::Length farthest{1000.0};
  std::optional<velum::Length> reference;
  velum::Length bin{0.001};

  static auto about() {
    return velum::About<RangeStatistics>("Mean, spread, drift and distribution of repeated ranges.")
        .in("cloud", "repeated scans of a target, with the scanner's place")
        .out("table", "one row a group")
        .out("histogram", "one row a group and bin")
        .choice(&RangeStatistics::per, "per", "what is looked at together",
                {{"all", Per::all, "all readings"},
                 {"beam", Per::beam, "those of one beam"},
                 {"label", Per::label, "those of one label"},
                 {"period", Per::period, "those of one period of time"}})
        .needs_when("per", "beam", "cloud", "beam")
        .needs_when("per", "label", "cloud", "label")
        .param(&RangeStatistics::period, "period", "with per = \"period\": its length",
               velum::above(0.0))
        .param(&RangeStatistics::beams, "beams", "only these beams; none: all of them")
        .param(&RangeStatistics::perpendicular, "perpendicular",
               "only the beam with the least mean range, as on a flat target")
        .param(&RangeStatistics::labels, "labels", "only points with these labels; none: all")
        .param(&RangeStatistics::nearest, "nearest", "readings below are not the target's",
               velum::at_least(0.0))
        .param(&RangeStatistics::farthest, "farthest", "readings beyond are not the target's",
               velum::above(0.0))
        .param(&RangeStatistics::reference, "reference", "the true distance of the target",
               velum::above(0.0))
        .param(&RangeStatistics::bin, "bin", "width of the histogram's bins", velum::above(0.0))
        .deterministic()
        .reference("Canciani, thesis, 2.4.3")
        .reference(
            "D'Agostino, Belanger, D'Agostino, A suggestion for using powerful and "
            "informative tests of normality, The American Statistician 44 (1990)");
  }

  std::tuple<Table, Table> operator()(const velum::Cloud& cloud, velum::Context& context) const;

 private:
  void add_row(Table& table, std::int64_t number, const Readings& readings,
               const Moments& found) const;
  void add_bins(Table& table, std::int64_t number, const Readings& readings,
                const Moments& found) const;
  void measure(const std::vector<Moments>& groups, velum::Context& context) const;
  void measure(const Readings& readings, velum::Context& context) const;
};

// A number, or nothing where it has no meaning.
velum::Cell known(bool meaning, double value) {
  return meaning ? velum::Cell(value) : velum::Cell(std::string());
}

bool can_be_tested(const Moments& found) {
  return found.count >= velum::metrology::kFewestForNormality && found.deviation > 0.0;
}

void RangeStatistics::add_row(Table& table, std::int64_t number, const Readings& readings,
                              const Moments& found) const {
  const Trend drift = velum::metrology::trend(readings.times, readings.ranges);
  const bool tested = can_be_tested(found);
  const double error = reference ? found.mean - *reference : 0.0;
  table.add({number, static_cast<std::int64_t>(found.count),
             readings.angle * 180.0 / std::numbers::pi, kMillimetre * found.mean,
             kMillimetre * found.deviation, kMillimetre * found.least, kMillimetre * found.greatest,
             found.skewness, found.kurtosis,
             known(tested, tested ? velum::metrology::normality(found).p : 0.0),
             kMillimetre * kHour * drift.slope, drift.p,
             known(reference.has_value(), kMillimetre * error),
             known(reference.has_value(), 100.0 * error / reference.value_or(1.0))});
}

// Bins begin at whole multiples of their width, so that those of several scans lie side by side.
void RangeStatistics::add_bins(Table& table, std::int64_t number, const Readings& readings,
                               const Moments& found) const {
  const double first = std::floor(found.least / bin);
  const double last = std::floor(found.greatest / bin);
  if (last - first >= kMostBins)
    throw velum::Error(velum::Fault::stage, "the histogram would have more than 100000 bins")
        .hint("set `bin` larger, or `nearest` and `farthest` around the target");
  std::vector<std::int64_t> counts(static_cast<std::size_t>(last - first) + 1);
  for (const double range : readings.ranges)
    ++counts[static_cast<std::size_t>(std::floor(range / bin) - first)];
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double from = (first + static_cast<double>(i)) * bin;
    const double normal = found.deviation > 0.0
                              ? velum::metrology::below(from + bin, found.mean, found.deviation) -
                                    velum::metrology::below(from, found.mean, found.deviation)
                              : 1.0;
    table.add({number, kMillimetre * from, kMillimetre * (from + bin), counts[i],
               normal * static_cast<double>(found.count)});
  }
}

// How the groups differ.
void RangeStatistics::measure(const std::vector<Moments>& groups, velum::Context& context) const {
  const auto by = [](auto member) {
    return [member](const Moments& a, const Moments& b) { return a.*member < b.*member; };
  };
  const auto means = std::minmax_element(groups.begin(), groups.end(), by(&Moments::mean));
  const auto spreads = std::minmax_element(groups.begin(), groups.end(), by(&Moments::deviation));
  context.measure("groups", static_cast<double>(groups.size()), "");
  context.measure("least_mean", means.first->mean, "m");
  context.measure("greatest_mean", means.second->mean, "m");
  context.measure("least_deviation", spreads.first->deviation, "m");
  context.measure("greatest_deviation", spreads.second->deviation, "m", velum::Better::lower);
}

// All readings together.
void RangeStatistics::measure(const Readings& readings, velum::Context& context) const {
  const Moments found = velum::metrology::moments(readings.ranges);
  context.measure("readings", static_cast<double>(found.count), "");
  context.measure("mean", found.mean, "m");
  context.measure("deviation", found.deviation, "m", velum::Better::lower);
  if (can_be_tested(found))
    context.measure("normality_p", velum::metrology::normality(found).p, "");
  const Trend drift = velum::metrology::trend(readings.times, readings.ranges);
  context.measure("drift", drift.slope, "m/s");
  context.measure("drift_p", drift.p, "");
  if (!reference) return;
  context.measure("error", found.mean - *reference, "m");
  context.measure("error_share", (found.mean - *reference) / *reference, "");
}

std::tuple<Table, Table> RangeStatistics::operator()(const velum::Cloud& cloud,
                                                     velum::Context& context) const {
  const Choice choice{per, period, nearest, farthest, beams, labels, perpendicular};
  const Groups groups = group(cloud, choice, context);
  if (groups.empty())
    throw velum::Error(
        velum::Fault::stage,
        "no reading of the cloud's " + std::to_string(cloud.size()) + " points is left to look at")
        .hint("see `beams`, `labels`, `nearest`, `farthest`");
  Table table({{name_of(per), ""},
               {"readings", ""},
               {"angle", "deg"},
               {"mean", "mm"},
               {"deviation", "mm"},
               {"least", "mm"},
               {"greatest", "mm"},
               {"skewness", ""},
               {"kurtosis", ""},
               {"normality_p", ""},
               {"drift", "mm/h"},
               {"drift_p", ""},
               {"error", "mm"},
               {"error_share", "%"}});
  Table histogram(
      {{name_of(per), ""}, {"from", "mm"}, {"to", "mm"}, {"readings", ""}, {"normal", ""}});
  Readings all;
  std::vector<Moments> found;
  for (const auto& [number, readings] : groups) {
    context.check();
    found.push_back(velum::metrology::moments(readings.ranges));
    add_row(table, number, readings, found.back());
    add_bins(histogram, number, readings, found.back());
    all.times.insert(all.times.end(), readings.times.begin(), readings.times.end());
    all.ranges.insert(all.ranges.end(), readings.ranges.begin(), readings.ranges.end());
  }
  measure(found, context);
  measure(all, context);
  return {std::move(table), std::move(histogram)};
}

}  // namespace

VELUM_STAGE(RangeStatistics)
