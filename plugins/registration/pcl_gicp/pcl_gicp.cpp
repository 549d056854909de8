// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <pcl/registration/gicp.h>

#include <cmath>
#include <velum/stage.hpp>

#include "pcl/clouds.hpp"
#include "registration/borrowed.hpp"

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct PclGicp {
  std::optional<velum::Length> max_distance;
  int neighbours = 20;
  int iterations = 200;
  velum::Length still_shift = 0.5e-3;
  velum::Angle still_angle{2e-3};

  static auto about() {
    return velum::About<PclGicp>("Generalised ICP (plane to plane) of the Point Cloud Library.")
        .in("source")
        .in("target")
        .in("initial", "where to start: source to target; without it the clouds as they are")
        .out("cloud", "the source in the target's frame")
        .out("transform", "source to target, with history")
        .out("table", "the history: one row an iteration")
        .param(&PclGicp::max_distance, "max_distance", "pairs farther apart do not count",
               velum::above(0.0))
        .param(&PclGicp::neighbours, "neighbours", "points that make the plane about each point",
               velum::between(4, 1000))
        .param(&PclGicp::iterations, "iterations", "at most so many", velum::between(1, 10000))
        .param(&PclGicp::still_shift, "still_shift",
               "end when no entry of a step's shift is more than this (and none of its turn more "
               "than still_angle)",
               velum::above(0.0))
        .param(&PclGicp::still_angle, "still_angle", "see still_shift", velum::above(0.0))
        .reference("PCL 1.13: pcl::GeneralizedIterativeClosestPoint")
        .reference("Segal, Haehnel, Thrun: Generalized-ICP. RSS 2009")
        .deterministic();
  }

  std::tuple<velum::Cloud, velum::Transform, velum::Table> operator()(
      const velum::Cloud& source, const velum::Cloud& target,
      const std::optional<velum::Transform>& initial, velum::Context& context) const {
    velum::registration::Borrowed run("PCL's GICP", source, target, initial, neighbours);
    using Points = pcl::PointCloud<pcl::PointXYZ>;
    std::function<void(const Points&, const pcl::Indices&, const Points&, const pcl::Indices&)>
        watch = [&](const Points& moved, const pcl::Indices& from, const Points& to,
                    const pcl::Indices& match) {
          if (from.empty()) return;  // the call by which it is registered
          double squares = 0.0;
          for (std::size_t k = 0; k < from.size(); ++k)
            squares +=
                static_cast<double>((moved[static_cast<std::size_t>(from[k])].getVector3fMap() -
                                     to[static_cast<std::size_t>(match[k])].getVector3fMap())
                                        .squaredNorm());
          const velum::Points positions = velum::with_pcl::positions_of(moved);
          run.iteration(velum::ConstPoints(positions.data(), 3, positions.cols()),
                        static_cast<velum::Index>(from.size()),
                        squares / static_cast<double>(from.size()), context);
        };
    pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> method;
    context.check();
    velum::with_pcl::quietly("PCL's GICP", [&] {
      method.setInputSource(velum::with_pcl::positions(run.source()));
      method.setInputTarget(velum::with_pcl::positions(run.target()));
      method.setCorrespondenceRandomness(neighbours);
      method.setMaximumIterations(iterations);
      method.setTransformationEpsilon(still_shift);
      method.setRotationEpsilon(still_angle.radians);
      // Without a limit its default of 5 m would stay.
      method.setMaxCorrespondenceDistance(max_distance ? static_cast<double>(*max_distance) : 1e9);
      method.registerVisualizationCallback(watch);
      Points moved;
      method.align(moved);
    });
    context.check();
    if (run.iterations() == 0)
      throw velum::Error(velum::Fault::stage, "PCL's GICP found too few pairs near enough")
          .hint(
              "bring the clouds closer first (registration.planes, registration.svd), or raise "
              "max_distance");
    return run.finish(method.getFinalTransformation().cast<double>(),
                      max_distance ? static_cast<double>(*max_distance) : kInfinity,
                      run.iterations() < iterations, context);
  }
};

}  // namespace
VELUM_STAGE(PclGicp)
