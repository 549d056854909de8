// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/icp.hpp"

#include <fmt/format.h>

#include <cmath>
#include <tuple>
#include <velum/stage.hpp>

namespace {

using velum::registration::IcpOptions;
using velum::registration::IcpResult;
using velum::registration::Metric;

/// Directions fixed less than this, relative to one that every pair fixes, deserve a warning.
constexpr double kWeak = 1e-3;

struct Icp {
  Metric metric = Metric::point_to_point;
  std::optional<velum::Length> max_distance;
  int iterations = 25;
  double relative_change = 1e-3;
  double keep = 1.0;
  int levels = 1;

  static auto about() {
    return velum::About<Icp>("Brings a cloud that lies nearly right onto another, step by step.")
        .in("source")
        .in("target")
        .in("initial", "where to start: source to target; without it the clouds as they are")
        .out("cloud", "the source in the target's frame")
        .out("transform", "source to target, with history")
        .out("table", "the history: one row an iteration, with the path of the source's barycentre")
        .choice(&Icp::metric, "metric", "what is minimised",
                {{"point_to_point", Metric::point_to_point, "distances of the pairs"},
                 {"point_to_plane", Metric::point_to_plane,
                  "distances from the target's tangent planes: fewer steps, needs normals"}})
        .needs_when("metric", "point_to_plane", "target", "normals")
        .param(&Icp::max_distance, "max_distance", "pairs farther apart do not count",
               velum::above(0.0))
        .param(&Icp::iterations, "iterations", "at most so many (at each level)",
               velum::between(1, 10000))
        .param(&Icp::relative_change, "relative_change",
               "end when the mean squared error changes by less than this share of itself",
               velum::between(0.0, 1.0))
        .param(&Icp::keep, "keep", "share of the pairs that counts, the nearest ones",
               velum::Range{.low = 0.0, .high = 1.0, .low_open = true})
        .param(&Icp::levels, "levels",
               "coarse to fine: each level before the last uses a quarter of the source points of "
               "the next",
               velum::between(1, 6))
        .reference("Canciani thesis, 3.2.2, algorithm 3.1, equations 3.16 to 3.24")
        .reference("Besl, McKay: A method for registration of 3-D shapes. PAMI 1992")
        .reference("Chen, Medioni: Object modeling by registration of multiple range images. 1991")
        .deterministic();
  }

  std::tuple<velum::Cloud, velum::Transform, velum::Table> operator()(
      const velum::Cloud& source, const velum::Cloud& target,
      const std::optional<velum::Transform>& initial, velum::Context& context) const {
    const velum::Pose start = velum::geometry::to_local(
        initial ? initial->matrix : velum::Pose::Identity(), source.origin(), target.origin());
    IcpOptions options{
        metric, std::numeric_limits<double>::infinity(), keep, iterations, relative_change, levels};
    if (max_distance) options.max_distance = *max_distance;
    const IcpResult result = velum::registration::icp(source, target, start, options, context);
    report(result, context);

    velum::Transform transform;
    transform.matrix = velum::geometry::to_true(result.pose, source.origin(), target.origin());
    transform.fitness = result.fitness;
    transform.history = velum::registration::history_table(result.steps);
    return {source.transformed(transform.matrix), transform, transform.history};
  }

 private:
  void report(const IcpResult& result, velum::Context& context) const {
    context.measure("fitness", result.fitness, "m^2", velum::Better::lower);
    context.measure("rmse", std::sqrt(result.fitness), "m", velum::Better::lower);
    context.measure("overlap", result.overlap, "", velum::Better::higher);
    context.measure("iterations", result.iterations, "", velum::Better::lower);
    context.measure("pairs", static_cast<double>(result.pairs), "");
    context.measure("weakest", result.directions.strength[0], "", velum::Better::higher);
    if (!result.converged)
      context.warn(fmt::format("ended after {} iterations, not because the error had settled",
                               result.iterations));
    for (int k = 0; k < 6; ++k)
      if (result.directions.strength[k] < kWeak)
        context.warn(fmt::format(
            "the pairs hardly fix {} (strength {:.1g} of 1): the pose is not to be trusted there",
            velum::registration::describe_direction(result.directions.axes.col(k)),
            result.directions.strength[k]));
  }
};

}  // namespace
VELUM_STAGE(Icp)
