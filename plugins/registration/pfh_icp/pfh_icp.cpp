// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "global/pfh_icp.hpp"

#include <fmt/format.h>

#include <cmath>
#include <tuple>
#include <velum/stage.hpp>

#include "geometry/motion.hpp"

namespace {

using velum::registration::PfhIcpOptions;
using velum::registration::PfhIcpResult;

struct PfhIcp {
  std::optional<velum::Length> max_distance;
  std::optional<velum::Length> resolution;
  double uncommon = 0.5;
  int similar = 100;
  int iterations = 25;
  double relative_change = 1e-3;

  static auto about() {
    return velum::About<PfhIcp>(
               "Brings a cloud that lies nearly right onto another by its uncommon points.")
        .in("source")
        .in("target")
        .in("initial", "where to start: source to target; without it the clouds as they are")
        .out("cloud", "the source in the target's frame")
        .out("transform", "source to target, with history")
        .out("table", "the history: one row an iteration, with the path of the source's barycentre")
        .param(&PfhIcp::max_distance, "max_distance",
               "pairs farther apart do not count, at the start; it shrinks to one cell; unset: a "
               "third of the source's diagonal",
               velum::above(0.0))
        .param(&PfhIcp::resolution, "resolution",
               "edge of the cells that both clouds are thinned to; unset: about 4,000 cells",
               velum::above(0.0))
        .param(&PfhIcp::uncommon, "uncommon",
               "share of the points that is compared, those whose histograms are least common",
               velum::Range{.low = 0.0, .high = 1.0, .low_open = true})
        .param(&PfhIcp::similar, "similar",
               "so many target points with the most similar histograms are drawn from",
               velum::between(1, 1000))
        .param(&PfhIcp::iterations, "iterations", "at most so many", velum::between(1, 10000))
        .param(&PfhIcp::relative_change, "relative_change",
               "end when the mean squared error changes by less than this share of itself",
               velum::between(0.0, 1.0))
        .reference("Canciani thesis, 3.2.2, equation 3.27")
        .reference("R. B. Rusu, Semantic 3D Object Maps (2010)")
        .seeded();
  }

  std::tuple<velum::Cloud, velum::Transform, velum::Table> operator()(
      const velum::Cloud& source, const velum::Cloud& target,
      const std::optional<velum::Transform>& initial, velum::Context& context) const {
    const velum::Pose start = velum::geometry::to_local(
        initial ? initial->matrix : velum::Pose::Identity(), source.origin(), target.origin());
    PfhIcpOptions options;
    if (max_distance) options.max_distance = *max_distance;
    if (resolution) options.cell = *resolution;
    options.uncommon = uncommon;
    options.similar = similar;
    options.iterations = iterations;
    options.relative_change = relative_change;
    const PfhIcpResult result =
        velum::registration::pfh_icp(source, target, start, options, context);
    report(result, context);

    velum::Transform transform;
    transform.matrix = velum::geometry::to_true(result.pose, source.origin(), target.origin());
    transform.fitness = result.fitness;
    transform.history = velum::registration::history_table(result.steps);
    return {source.transformed(transform.matrix), transform, transform.history};
  }

 private:
  static void report(const PfhIcpResult& result, velum::Context& context) {
    using velum::Better;
    context.measure("fitness", result.fitness, "m^2", Better::lower);
    context.measure("rmse", std::sqrt(result.fitness), "m", Better::lower);
    context.measure("overlap", result.overlap, "", Better::higher);
    context.measure("iterations", static_cast<double>(result.steps.size() - 1), "", Better::lower);
    context.measure("pairs", static_cast<double>(result.pairs), "");
    const auto& directions = result.directions;
    context.measure("weakest", directions.strength[0], "", Better::higher);
    for (int k = 0; k < 6 && directions.strength[k] < velum::registration::kFreeStrength; ++k)
      context.warn(fmt::format(
          "the pairs hardly fix {} (strength {:.1g} of 1): the pose is not to be trusted there",
          velum::registration::describe_direction(directions.axes.col(k)), directions.strength[k]));
    if (!result.converged)
      context.warn(fmt::format("ended after {} iterations, not because the error had settled",
                               result.steps.size() - 1));
  }
};

}  // namespace
VELUM_STAGE(PfhIcp)
