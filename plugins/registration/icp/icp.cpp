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
using velum::registration::Kernel;
using velum::registration::Metric;
using velum::registration::Pairing;
using velum::registration::Sampling;
using velum::registration::Solver;

enum class Correspondences { nearest, reciprocal, compatible_normals };

struct Icp {
  Metric metric = Metric::point_to_point;
  Solver solver = Solver::automatic;
  std::optional<velum::Length> max_distance;
  int iterations = 25;
  double relative_change = 1e-3;
  std::optional<velum::Angle> still_angle;
  std::optional<velum::Length> still_shift;
  Correspondences correspondences = Correspondences::nearest;
  velum::Angle normal_angle{std::numbers::pi / 4.0};
  double keep = 1.0;
  Kernel kernel = Kernel::none;
  std::optional<velum::Length> kernel_scale;
  Sampling sampling = Sampling::all;
  double sample = 0.1;
  int levels = 1;

  static auto about() {
    velum::About<Icp> about("Brings a cloud that lies nearly right onto another, step by step.");
    about.version("2")
        .in("source")
        .in("target")
        .in("initial", "where to start: source to target; without it the clouds as they are")
        .out("cloud", "the source in the target's frame")
        .out("transform", "source to target, with history")
        .out("table", "the history: one row an iteration, with the path of the source's barycentre")
        .out("directions",
             "how firmly the surfaces fix each direction of motion, the least certain first: turn "
             "(as arc at radius) and shift of the source's barycentre")
        .out("covariance",
             "of the turn [rad] and the shift [m] of the source's barycentre, free directions left "
             "out")
        .reference("Canciani thesis, 3.2.2, algorithm 3.1, equations 3.16 to 3.26")
        .reference("Besl, McKay: A method for registration of 3-D shapes. PAMI 1992")
        .reference("Chen, Medioni: Object modeling by registration of multiple range images. 1991")
        .reference("Pottmann, Leopoldseder, Hofer: Registration without ICP. CVIU 2004")
        .reference("Rusinkiewicz: A symmetric objective function for ICP. SIGGRAPH 2019")
        .seeded();
    describe_steps(about);
    describe_pairs(about);
    return about;
  }

  std::tuple<velum::Cloud, velum::Transform, velum::Table, velum::Table, velum::Table> operator()(
      const velum::Cloud& source, const velum::Cloud& target,
      const std::optional<velum::Transform>& initial, velum::Context& context) const {
    const velum::Pose start = velum::geometry::to_local(
        initial ? initial->matrix : velum::Pose::Identity(), source.origin(), target.origin());
    const IcpResult result = velum::registration::icp(source, target, start, options(), context);
    report(result, context);

    velum::Transform transform;
    transform.matrix = velum::geometry::to_true(result.pose, source.origin(), target.origin());
    transform.fitness = result.fitness;
    transform.history = velum::registration::history_table(result.steps);
    return {source.transformed(transform.matrix), transform, transform.history,
            velum::registration::directions_table(result.uncertainty),
            velum::registration::covariance_table(result.uncertainty)};
  }

 private:
  static void describe_steps(velum::About<Icp>& about) {
    about
        .choice(&Icp::metric, "metric", "what is minimised",
                {{"point_to_point", Metric::point_to_point, "distances of the pairs"},
                 {"point_to_plane", Metric::point_to_plane,
                  "distances from the target's tangent planes: fewer steps, needs normals"},
                 {"symmetric", Metric::symmetric,
                  "distances along the mean of both normals, zero wherever both lie on one curved "
                  "surface: fewest steps and the widest reach, needs normals of both"}})
        .needs_when("metric", "point_to_plane", "target", "normals")
        .needs_when("metric", "symmetric", "target", "normals")
        .needs_when("metric", "symmetric", "source", "normals")
        .choice(
            &Icp::solver, "solver", "how a step's motion is found",
            {{"automatic", Solver::automatic, "svd for point_to_point, else helical"},
             {"svd", Solver::svd, "best motion of the pairs at once; point_to_point only"},
             {"linearised", Solver::linearised,
              "velocities by least squares, applied as small angles about the axes (thesis 3.25)"},
             {"helical", Solver::helical,
              "the same, applied as the helical motion that has these velocities"}})
        .param(&Icp::max_distance, "max_distance", "pairs farther apart do not count",
               velum::above(0.0))
        .param(&Icp::iterations, "iterations", "at most so many (at each level)",
               velum::between(1, 10000))
        .param(&Icp::relative_change, "relative_change",
               "end when the mean squared error changes by less than this share of itself",
               velum::between(0.0, 1.0))
        .param(&Icp::still_angle, "still_angle",
               "end when a step turns by less than this (and shifts by less than still_shift)",
               velum::above(0.0))
        .param(&Icp::still_shift, "still_shift",
               "end when a step shifts the barycentre by less than this (and turns by less than "
               "still_angle)",
               velum::above(0.0));
  }

  static void describe_pairs(velum::About<Icp>& about) {
    about
        .choice(&Icp::correspondences, "correspondences", "which pairs count",
                {{"nearest", Correspondences::nearest,
                  "each source point with the nearest of the "
                  "target"},
                 {"reciprocal", Correspondences::reciprocal,
                  "of these, those that are nearest to each other"},
                 {"compatible_normals", Correspondences::compatible_normals,
                  "of these, those whose normals differ by less than normal_angle"}})
        .needs_when("correspondences", "compatible_normals", "target", "normals")
        .needs_when("correspondences", "compatible_normals", "source", "normals")
        .param(&Icp::normal_angle, "normal_angle", "for compatible_normals",
               velum::Range{.low = 0.0, .high = std::numbers::pi, .low_open = true})
        .param(&Icp::keep, "keep", "share of the pairs that counts, the nearest ones",
               velum::Range{.low = 0.0, .high = 1.0, .low_open = true})
        .choice(&Icp::kernel, "kernel", "weight of a pair by its gap",
                {{"none", Kernel::none, "all alike"},
                 {"huber", Kernel::huber, "falls off beyond 1.345 standard deviations"},
                 {"tukey", Kernel::tukey, "nothing beyond 4.685 standard deviations"}})
        .param(&Icp::kernel_scale, "kernel_scale",
               "that standard deviation; unset: from the median gap, anew at each step",
               velum::above(0.0))
        .choice(&Icp::sampling, "sampling", "which source points are used",
                {{"all", Sampling::all, "every one"},
                 {"random", Sampling::random, "a random share of them"},
                 {"curvature", Sampling::curvature,
                  "a share, the likelier the more the surface bends; needs curvature"}})
        .needs_when("sampling", "curvature", "source", "curvature")
        .param(&Icp::sample, "sample", "share that sampling takes (at least 100 points)",
               velum::Range{.low = 0.0, .high = 1.0, .low_open = true})
        .param(&Icp::levels, "levels",
               "coarse to fine: each level before the last uses a quarter of the source points of "
               "the next",
               velum::between(1, 6));
  }

  [[nodiscard]] IcpOptions options() const {
    IcpOptions options{
        metric, std::numeric_limits<double>::infinity(), keep, iterations, relative_change, levels};
    if (max_distance) options.max_distance = *max_distance;
    options.solver = solver;
    if (correspondences == Correspondences::reciprocal) options.pairing = Pairing::reciprocal;
    if (correspondences == Correspondences::compatible_normals)
      options.normal_angle = normal_angle.radians;
    options.sampling = sampling;
    options.sample = sample;
    options.kernel = kernel;
    if (kernel_scale) options.kernel_scale = *kernel_scale;
    if (still_angle) options.still_rotation = still_angle->radians;
    if (still_shift) options.still_translation = *still_shift;
    return options;
  }

  static void report(const IcpResult& result, velum::Context& context) {
    using velum::Better;
    const auto& uncertainty = result.uncertainty;
    context.measure("fitness", result.fitness, "m^2", Better::lower);
    context.measure("rmse", std::sqrt(result.fitness), "m", Better::lower);
    context.measure("overlap", result.overlap, "", Better::higher);
    context.measure("iterations", result.iterations, "", Better::lower);
    context.measure("pairs", static_cast<double>(result.pairs), "");
    context.measure("weakest", uncertainty.directions.strength[0], "", Better::higher);
    context.measure("free_directions", uncertainty.free, "", Better::lower);
    context.measure("deviation_rotation", uncertainty.rotation(), "rad", Better::lower);
    context.measure("deviation_translation", uncertainty.translation(), "m", Better::lower);
    if (!result.converged)
      context.warn(fmt::format("ended after {} iterations, not because the error had settled",
                               result.iterations));
    for (int k = 0; k < uncertainty.free; ++k)
      context.warn(fmt::format(
          "the pairs hardly fix {} (strength {:.1g} of 1): the pose is not to be trusted there",
          velum::registration::describe_direction(uncertainty.directions.axes.col(k)),
          uncertainty.directions.strength[k]));
  }
};

}  // namespace
VELUM_STAGE(Icp)
