// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <tuple>
#include <velum/stage.hpp>

#include "geometry/motion.hpp"
#include "global/register_globally.hpp"

namespace {

using velum::registration::GlobalOptions;
using velum::registration::GlobalResult;

struct Global {
  std::optional<velum::Length> resolution;
  double min_overlap = 0.15;
  double min_evidence = 0.15;
  int min_matches = 12;
  bool planes = true;
  velum::Length max_deviation = velum::diagonals(0.001);

  static auto about() {
    return velum::About<Global>(
               "Registers two clouds from any start, without a user, or says why it cannot.")
        .in("source")
        .in("target")
        .out("cloud", "the source in the target's frame")
        .out("transform", "source to target, with history; good to a fraction of the resolution")
        .out("table", "the history of the refinement: one row an iteration")
        .param(&Global::resolution, "resolution",
               "edge of the cells that both clouds are thinned to, all other lengths follow from "
               "it; unset: about 4,000 cells, and where that does not do, finer and coarser ones",
               velum::above(0.0))
        .advanced()
        .param(&Global::min_overlap, "min_overlap",
               "refuse when less than this share of the smaller cloud lies on the other",
               velum::between(0.0, 1.0))
        .param(&Global::min_evidence, "min_evidence",
               "refuse when another pose has the best one's evidence less this share of it",
               velum::between(0.0, 1.0))
        .param(&Global::min_matches, "min_matches",
               "refuse when fewer pairs of features than this agree with the pose",
               velum::at_least(4))
        .advanced()
        .param(&Global::planes, "planes",
               "where both clouds say where their scanners stood, try walls, floor and ceiling "
               "first, as registration.planes does")
        .param(&Global::max_deviation, "max_deviation",
               "a pose by planes that is not known better than this, one standard deviation, does "
               "not count",
               velum::above(0.0))
        .of("target")
        .advanced()
        .reference("Rusu, Blodow, Beetz: Fast point feature histograms. ICRA 2009; thesis 3.1.6")
        .reference("Yang, Shi, Carlone: TEASER. IEEE Transactions on Robotics 2020")
        .reference("Shi, Yang, Carlone: ROBIN. ICRA 2021")
        .reference("Yang, Antonante, Tzoumas, Carlone: Graduated non-convexity. RA-L 2020")
        .reference("Canciani thesis, 3.2.3, algorithm 3.2 (planes)")
        .deterministic();
  }

  std::tuple<velum::Cloud, velum::Transform, velum::Table> operator()(
      const velum::Cloud& source, const velum::Cloud& target, velum::Context& context) const {
    GlobalOptions options;
    options.cell = resolution ? static_cast<double>(*resolution) : 0.0;
    options.least_overlap = min_overlap;
    options.least_gap = min_evidence;
    options.least_matches = min_matches;
    options.planes = planes;
    options.most_deviation = max_deviation;
    const GlobalResult result =
        velum::registration::register_globally(source, target, options, context);
    report(result, context);

    velum::Transform transform;
    transform.matrix = velum::geometry::to_true(result.pose, source.origin(), target.origin());
    transform.fitness = result.seen.fitness;
    transform.history = velum::registration::history_table(result.steps);
    return {source.transformed(transform.matrix), transform, transform.history};
  }

 private:
  static void report(const GlobalResult& result, velum::Context& context) {
    using velum::Better;
    context.measure("fitness", result.seen.fitness, "m^2", Better::lower);
    context.measure("rmse", std::sqrt(std::max(0.0, result.seen.fitness)), "m", Better::lower);
    context.measure("overlap", result.seen.overlap, "", Better::higher);
    context.measure("iterations", static_cast<double>(result.steps.size()), "");
    context.measure("agreement", result.seen.share, "", Better::higher);
    context.measure("evidence", result.gap, "", Better::higher);
    context.measure("contradiction", result.contradiction, "", Better::lower);
    context.measure("candidates", static_cast<double>(result.candidates), "");
    context.measure("by_planes", result.by_planes ? 1.0 : 0.0, "");
    context.measure("deviation_rotation", result.deviations.rotation, "rad", Better::lower);
    context.measure("deviation_translation", result.deviations.translation, "m", Better::lower);
    if (result.by_planes) return;
    context.measure("matches", static_cast<double>(result.matches), "");
    context.measure("inliers", static_cast<double>(result.inliers), "", Better::higher);
    context.measure("resolution", result.cell, "m");
    context.measure("weakest", result.weakest, "", Better::higher);
  }
};

}  // namespace
VELUM_STAGE(Global)
