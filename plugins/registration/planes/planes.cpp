// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <tuple>
#include <velum/stage.hpp>

#include "registration/picked_pair.hpp"
#include "registration/register_planes.hpp"

namespace {

using velum::registration::PickedPair;
using velum::registration::PlanesOptions;
using velum::registration::PlanesResult;

struct Planes {
  std::vector<PickedPair> picks;
  std::optional<velum::Length> resolution;
  double min_overlap = 0.05;
  double min_evidence = 0.1;
  velum::Length max_deviation = velum::diagonals(0.001);

  static auto about() {
    return velum::About<Planes>(
               "Registers two scans of a room from any start, by its walls, floor and ceiling.")
        .in("source")
        .in("target")
        .out("cloud", "the source in the target's frame")
        .out("transform", "source to target, with history")
        .out("table", "the history of the refinement: one row an iteration")
        .rows(&Planes::picks, "picks",
              "points on planes that are the same, where the scans alone do not tell",
              velum::Row<PickedPair>()
                  .field(&PickedPair::source, "source", "on a plane of the source")
                  .field(&PickedPair::target, "target", "on the same plane in the target"))
        .param(&Planes::resolution, "resolution",
               "edge of the cells over which planes are grown; unset: about 16,000 cells a cloud",
               velum::above(0.0))
        .advanced()
        .param(&Planes::min_overlap, "min_overlap",
               "refuse when less of the source than this lies near the target",
               velum::between(0.0, 1.0))
        .param(&Planes::min_evidence, "min_evidence",
               "refuse when the next pose is borne out by as much of the scene, less this share",
               velum::between(0.0, 1.0))
        .param(&Planes::max_deviation, "max_deviation",
               "refuse when the pose is not known better than this, one standard deviation",
               velum::above(0.0))
        .of("target")
        .reference("Canciani thesis, 3.2.3, algorithm 3.2")
        .deterministic();
  }

  std::tuple<velum::Cloud, velum::Transform, velum::Table> operator()(
      const velum::Cloud& source, const velum::Cloud& target, velum::Context& context) const {
    for (const auto& [cloud, name] : {std::pair(&source, "source"), std::pair(&target, "target")})
      if (cloud->sensors().empty())
        context.warn(
            fmt::format("the {} does not say where its scanner stood: taken to be the origin "
                        "of its axes",
                        name));
    PlanesOptions options;
    options.cell = resolution ? static_cast<double>(*resolution) : 0.0;
    options.least_overlap = min_overlap;
    options.least_gap = min_evidence;
    options.most_deviation = max_deviation;
    for (const PickedPair& pick : picks)
      options.picks.push_back({pick.source.metres, pick.target.metres});
    const PlanesResult result =
        velum::registration::register_planes(source, target, options, context);
    report(result, context);

    velum::Transform transform;
    transform.matrix = velum::geometry::to_true(result.pose, source.origin(), target.origin());
    transform.fitness = result.fitness;
    transform.history = velum::registration::history_table(result.steps);
    return {source.transformed(transform.matrix), transform, transform.history};
  }

 private:
  static void report(const PlanesResult& result, velum::Context& context) {
    using velum::Better;
    context.measure("fitness", result.fitness, "m^2", Better::lower);
    context.measure("rmse", std::sqrt(result.fitness), "m", Better::lower);
    context.measure("overlap", result.overlap, "", Better::higher);
    context.measure("iterations", static_cast<double>(result.steps.size()), "");
    context.measure("planes", result.matched, "", Better::higher);
    context.measure("candidates", result.candidates, "");
    context.measure("evidence", result.gap, "", Better::higher);
    context.measure("agreement", result.agrees, "", Better::higher);
    context.measure("contradiction", result.blocked, "", Better::lower);
    context.measure("residual", result.sigma, "m", Better::lower);
    context.measure("plane_residual", result.plane_gap, "m", Better::lower);
    context.measure("deviation_rotation", result.deviations.rotation, "rad", Better::lower);
    context.measure("deviation_translation", result.deviations.translation, "m", Better::lower);
    context.info(fmt::format("weakest direction: {}, known to {:.2g} m",
                             velum::registration::describe_direction(result.weakest),
                             result.deviations.translation));
  }
};

}  // namespace
VELUM_STAGE(Planes)
