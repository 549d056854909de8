// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include <map>

#include "deviation/statistics.hpp"

namespace {

using velum::Cloud;
using velum::Context;
using velum::Index;

enum class Match { automatic, order, beam, nearest };
enum Grade : std::int32_t { good, fair, bad };

bool has_beams(const Cloud& cloud) {
  for (const char* name : {velum::column::kBeam, velum::column::kLine})
    if (!cloud.has(name) || cloud.column(name).scalar() != velum::Scalar::i32 ||
        cloud.column(name).width() != 1)
      return false;
  return true;
}

// What a beam is called in all clouds made from one scan: sensor, line, beam.
using Beam = std::tuple<std::size_t, std::int32_t, std::int32_t>;
Beam beam_of(const Cloud& cloud, Index i) {
  return {cloud.sensor_of(i).value_or(0),
          cloud.column(velum::column::kLine).vector<std::int32_t>()[i],
          cloud.column(velum::column::kBeam).vector<std::int32_t>()[i]};
}

// The point of `before` that each point of `after` was; -1: none.
std::vector<std::int32_t> by_beam(const Cloud& after, const Cloud& before) {
  std::map<Beam, std::int32_t> place;
  for (Index i = 0; i < before.size(); ++i)
    place.emplace(beam_of(before, i), static_cast<std::int32_t>(i));
  std::vector<std::int32_t> source;
  for (Index i = 0; i < after.size(); ++i) {
    const auto found = place.find(beam_of(after, i));
    source.push_back(found == place.end() ? -1 : found->second);
  }
  return source;
}

std::vector<std::int32_t> by_nearest(const Cloud& after, const Cloud& before, Context& context) {
  std::vector<std::int32_t> source(static_cast<std::size_t>(after.size()), -1);
  if (before.empty()) return source;
  before.neighbours().each_nearest(after.positions(), 1, context,
                                   [&](Index i, std::span<const velum::Neighbour> found) {
                                     source[static_cast<std::size_t>(i)] = found.front().index;
                                   });
  return source;
}

struct Displacement {
  Match match = Match::automatic;
  velum::Length good_limit = 0.004;
  velum::Length bad_limit = 0.009;
  int bins = 20;

  static auto about() {
    return velum::About<Displacement>(
               "How far each point was moved, in the grades good, fair and bad.")
        .in("cloud", "after, from a resampling")
        .in("reference", "the same points before")
        .out("table", "histogram of the displacements, then the grades")
        .out("cloud", "the input with the columns displacement [m] and grade")
        .adds("cloud", "displacement")
        .adds("cloud", "grade")
        .param(&Displacement::good_limit, "good",
               "points moved less are good: within the noise of the scanner", velum::at_least(0.0))
        .param(&Displacement::bad_limit, "bad",
               "points moved more are bad: beyond noise and systematic error of the scanner",
               velum::at_least(0.0))
        .choice(&Displacement::match, "match", "which point a point was",
                {{"auto", Match::automatic,
                  "order where both have as many points; else beam where both know it; else "
                  "nearest"},
                 {"order", Match::order, "the one of the same number"},
                 {"beam", Match::beam, "the one of the same sensor, line and beam"},
                 {"nearest", Match::nearest, "the nearest one"}})
        .param(&Displacement::bins, "bins", "ranges of the histogram", velum::between(1, 1000))
        .deterministic()
        .reference("thesis 3.4: tables 3.30 and 3.31, figures 3.52, 3.54 and 3.56");
  }

  void check() const {
    if (good_limit.of == bad_limit.of && good_limit > bad_limit)
      throw velum::Error(velum::Fault::graph, "'good' is greater than 'bad'").at("good");
  }

  std::tuple<velum::Table, Cloud> operator()(const Cloud& cloud, const Cloud& reference,
                                             Context& context) const {
    context.check();
    const std::vector<std::int32_t> source = sources(cloud, reference, context);
    const auto after = cloud.positions();
    const auto before = reference.positions();
    Eigen::VectorXf moved(cloud.size());
    Eigen::VectorXi grade(cloud.size());
    for (Index i = 0; i < cloud.size(); ++i) {
      const std::int32_t from = source[static_cast<std::size_t>(i)];
      moved[i] = static_cast<float>((after.col(i) - before.col(from)).cast<double>().norm());
      grade[i] = static_cast<double>(moved[i]) < good_limit  ? good
                 : static_cast<double>(moved[i]) > bad_limit ? bad
                                                             : fair;
    }
    velum::Table table = report(moved, grade, context);
    return {std::move(table), cloud.with("displacement", velum::Column(std::move(moved)))
                                  .with("grade", velum::Column(std::move(grade)))};
  }

 private:
  [[nodiscard]] std::vector<std::int32_t> sources(const Cloud& cloud, const Cloud& reference,
                                                  Context& context) const {
    const bool same_count = cloud.size() == reference.size();
    const bool beams = has_beams(cloud) && has_beams(reference);
    Match chosen = match;
    if (match == Match::automatic)
      chosen = same_count ? Match::order : beams ? Match::beam : Match::nearest;
    if (chosen == Match::order) {
      if (!same_count)
        throw velum::Error(velum::Fault::stage,
                           "the cloud has " + std::to_string(cloud.size()) +
                               " points and the reference " + std::to_string(reference.size()) +
                               ": they cannot be the same ones in the same order")
            .hint("use match = \"beam\" or \"nearest\"");
      std::vector<std::int32_t> same(static_cast<std::size_t>(cloud.size()));
      for (std::size_t i = 0; i < same.size(); ++i) same[i] = static_cast<std::int32_t>(i);
      return same;
    }
    if (chosen == Match::beam && !beams)
      throw velum::Error(velum::Fault::stage,
                         "match = \"beam\" needs the columns beam and line on both clouds");
    const auto found =
        chosen == Match::beam ? by_beam(cloud, reference) : by_nearest(cloud, reference, context);
    const auto strangers = std::count(found.begin(), found.end(), -1);
    if (strangers > 0)
      throw velum::Error(velum::Fault::stage,
                         std::to_string(strangers) + " of " + std::to_string(cloud.size()) +
                             " points have none in the reference that they could have been")
          .hint("use match = \"nearest\", and a reference with points");
    return found;
  }

  velum::Table report(const Eigen::VectorXf& moved, const Eigen::VectorXi& grade,
                      Context& context) const {
    velum::Table table = velum::deviation::histogram_table();
    velum::deviation::add_histogram(table, "displacement", "m", moved, bins, 0.0);
    const double all = static_cast<double>(std::max<Index>(grade.size(), 1));
    const double edges[] = {
        0.0, good_limit, bad_limit,
        std::max<double>(bad_limit,
                         moved.size() > 0 ? static_cast<double>(moved.maxCoeff()) : 0.0)};
    const char* names[] = {"good", "fair", "bad"};
    for (const Grade one : {good, fair, bad}) {
      const std::int64_t count = (grade.array() == static_cast<int>(one)).count();
      const double share = static_cast<double>(count) / all;
      table.add({std::string(names[one]), std::string("m"), edges[one], edges[one + 1], count,
                 100.0 * share});
      context.measure(names[one], share, "",
                      one == good  ? velum::Better::higher
                      : one == bad ? velum::Better::lower
                                   : velum::Better::neither);
    }
    velum::deviation::report(velum::deviation::statistics(moved), "", "m", context);
    return table;
  }
};

}  // namespace
VELUM_STAGE(Displacement)
