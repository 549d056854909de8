// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <velum/stage.hpp>

#include "sheet.hpp"

namespace {

using velum::Index;
using velum::sails::Sheet;
using velum::sails::Verdict;

struct Candidate {
  int cluster = 0;
  std::vector<std::int32_t> members;
  Sheet sheet;
  Verdict verdict;
  int sail = -1;  // number among the sails, from the largest; -1 when it is none
};

struct SelectSail {
  int index = 0;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  int min_points = 100;
  double min_area = 0.0;
  std::optional<double> max_area;
  double min_aspect = 1.0;
  double max_aspect = 7.0;
  double min_bend = 0.012;
  double max_bend = 0.25;
  double smoothness = 0.03;
  double share = 0.25;
  std::optional<velum::Place> near;
  velum::Length within = velum::diagonals(0.25);

  static auto about() {
    return velum::About<SelectSail>("The sails among the clusters of a scene, one as a cloud.")
        .in("clusters")
        .out("cloud", "the sail numbered `index`: its points in their order, with all columns")
        .out("table", "one row a cluster: its figures, score, and the reason for or against")
        .param(&SelectSail::index, "index", "number of the sail, from 0 for the largest",
               velum::at_least(0))
        .param(&SelectSail::up, "up", "what is up, in the clusters' frame")
        .param(&SelectSail::min_points, "min_points", "clusters with fewer points are no sails",
               velum::at_least(1))
        .param(&SelectSail::min_area, "min_area", "least area of a sail", velum::at_least(0.0))
        .unit("m^2")
        .param(&SelectSail::max_area, "max_area", "greatest area of a sail; unset: any",
               velum::above(0.0))
        .unit("m^2")
        .param(&SelectSail::min_aspect, "min_aspect", "least height / width", velum::above(0.0))
        .param(&SelectSail::max_aspect, "max_aspect", "greatest height / width", velum::above(0.0))
        .param(&SelectSail::min_bend, "min_bend",
               "least curvature: root mean square distance from its plane / width",
               velum::at_least(0.0))
        .param(&SelectSail::max_bend, "max_bend", "greatest such distance / width",
               velum::above(0.0))
        .param(&SelectSail::smoothness, "smoothness",
               "greatest root mean square distance from a cubic over its plane / width",
               velum::above(0.0))
        .param(&SelectSail::share, "share", "least area of a sail / area of the largest one",
               velum::between(0.0, 1.0))
        .param(&SelectSail::near, "near", "hint: a place that the sail's centre is near to")
        .param(&SelectSail::within, "within", "greatest distance from `near`", velum::above(0.0))
        .deterministic()
        .reference("thesis 4.2 and 4.3, where the sails' clusters were chosen by hand");
  }

  void check() const {
    if (!(up.norm() > 1e-9))
      throw velum::Error(velum::Fault::graph, "up = [0, 0, 0] is no direction").at("up");
  }

  std::tuple<velum::Cloud, velum::Table> operator()(const velum::Clusters& clusters,
                                                    velum::Context& context) const {
    context.check();
    std::vector<Candidate> candidates = measure_all(clusters, context);
    const int sails = number(candidates);
    context.measure("candidates", static_cast<double>(candidates.size()), "");
    context.measure("sails", sails, "");
    velum::Cloud chosen = clusters.cloud.select(members_of(candidates, sails, context));
    context.measure("points", static_cast<double>(chosen.size()), "");
    return {std::move(chosen), table_of(candidates, clusters.cloud)};
  }

 private:
  [[nodiscard]] velum::sails::Demands demands(const velum::Cloud& cloud) const {
    velum::sails::Demands made;
    made.min_area = min_area;
    made.max_area = max_area;
    made.min_aspect = min_aspect;
    made.max_aspect = max_aspect;
    made.min_bend = min_bend;
    made.max_bend = max_bend;
    made.smoothness = smoothness;
    if (near) made.near = near->metres - cloud.origin();
    made.within = within;
    return made;
  }

  [[nodiscard]] std::vector<Candidate> measure_all(const velum::Clusters& clusters,
                                                   velum::Context& context) const {
    const auto labels = clusters.label();
    const int count = labels.size() == 0 ? 0 : labels.maxCoeff() + 1;
    std::vector<Candidate> candidates(static_cast<std::size_t>(std::max(count, 0)));
    for (Index i = 0; i < labels.size(); ++i)
      if (labels[i] >= 0)
        candidates[static_cast<std::size_t>(labels[i])].members.push_back(
            static_cast<std::int32_t>(i));
    const velum::sails::Demands wanted = demands(clusters.cloud);
    const Eigen::Vector3d direction = up.normalized();
    const auto each = static_cast<Index>(candidates.size());
    velum::parallel_for(context, each, 1, [&](Index begin, Index) {
      Candidate& one = candidates[static_cast<std::size_t>(begin)];
      one.cluster = static_cast<int>(begin);
      one.sheet = velum::sails::measure(clusters.cloud, one.members, direction, context);
      one.verdict = one.sheet.points < min_points
                        ? Verdict{0.0, fmt::format("few points: {} of at least {}",
                                                   one.sheet.points, min_points)}
                        : velum::sails::judge(one.sheet, wanted);
    });
    return candidates;
  }

  // Numbers the sails from the largest; those small beside it are parts of sails, or flags.
  [[nodiscard]] int number(std::vector<Candidate>& candidates) const {
    std::vector<Candidate*> sails;
    for (Candidate& one : candidates)
      if (one.verdict.sail()) sails.push_back(&one);
    std::stable_sort(sails.begin(), sails.end(), [](const Candidate* a, const Candidate* b) {
      return a->sheet.area > b->sheet.area;
    });
    int count = 0;
    for (Candidate* one : sails) {
      const double part = one->sheet.area / sails.front()->sheet.area;
      if (part >= share) {
        one->sail = count++;
        continue;
      }
      one->verdict.score *= part;
      one->verdict.reason = fmt::format("small beside the largest sail: {:.3f} of its area", part);
    }
    return count;
  }

  [[nodiscard]] std::vector<std::int32_t> members_of(const std::vector<Candidate>& candidates,
                                                     int sails, velum::Context& context) const {
    for (const Candidate& one : candidates)
      if (one.sail == index) return one.members;
    if (index > 0 && !candidates.empty())
      throw velum::Error(velum::Fault::stage,
                         fmt::format("sail {} was asked for, but {} found (from 0)", index,
                                     sails == 1 ? "1 was" : fmt::format("{} were", sails)))
          .hint("the table says why each cluster is a sail or not: ask for index = 0 to see it");
    context.warn("no cluster is a sail; the table says why");
    return {};
  }

  static velum::Table table_of(const std::vector<Candidate>& candidates,
                               const velum::Cloud& cloud) {
    velum::Table table({{"cluster", ""},
                        {"sail", ""},
                        {"score", ""},
                        {"points", ""},
                        {"area", "m^2"},
                        {"height", "m"},
                        {"width", "m"},
                        {"aspect", ""},
                        {"bend", "m"},
                        {"roughness", "m"},
                        {"top", ""},
                        {"lean", "rad"},
                        {"centre_x", "m"},
                        {"centre_y", "m"},
                        {"centre_z", "m"},
                        {"reason", ""}});
    for (const Candidate& one : candidates) {
      const Eigen::Vector3d centre = one.sheet.centre + cloud.origin();
      table.add({std::int64_t{one.cluster}, std::int64_t{one.sail}, one.verdict.score,
                 std::int64_t{one.sheet.points}, one.sheet.area, one.sheet.height, one.sheet.width,
                 one.sheet.aspect(), one.sheet.bend, one.sheet.roughness, one.sheet.top,
                 one.sheet.lean, centre.x(), centre.y(), centre.z(), one.verdict.reason});
    }
    return table;
  }
};

}  // namespace
VELUM_STAGE(SelectSail)
