// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <pcl/registration/icp.h>

#include <cmath>
#include <velum/stage.hpp>

#include "pcl/clouds.hpp"
#include "registration/borrowed.hpp"

namespace {

using velum::registration::Borrowed;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

enum class Metric { point_to_point, point_to_plane, symmetric };
enum class Correspondences { nearest, reciprocal };

struct PclIcp {
  Metric metric = Metric::point_to_point;
  std::optional<velum::Length> max_distance;
  int iterations = 25;
  double relative_change = 1e-3;
  Correspondences correspondences = Correspondences::nearest;

  static auto about() {
    return velum::About<PclIcp>("Iterative closest point of the Point Cloud Library.")
        .in("source")
        .in("target")
        .in("initial", "where to start: source to target; without it the clouds as they are")
        .out("cloud", "the source in the target's frame")
        .out("transform", "source to target, with history")
        .out("table", "the history: one row an iteration")
        .choice(&PclIcp::metric, "metric", "what is minimised",
                {{"point_to_point", Metric::point_to_point, "distances of the pairs"},
                 {"point_to_plane", Metric::point_to_plane,
                  "distances from the target's tangent planes; needs normals of both"},
                 {"symmetric", Metric::symmetric,
                  "distances along the mean of both normals; needs normals of both"}})
        .needs_when("metric", "point_to_plane", "source", "normals")
        .needs_when("metric", "point_to_plane", "target", "normals")
        .needs_when("metric", "symmetric", "source", "normals")
        .needs_when("metric", "symmetric", "target", "normals")
        .param(&PclIcp::max_distance, "max_distance", "pairs farther apart do not count",
               velum::above(0.0))
        .param(&PclIcp::iterations, "iterations", "at most so many", velum::between(1, 10000))
        .param(&PclIcp::relative_change, "relative_change",
               "end when the mean squared error changes by less than this share of itself",
               velum::between(0.0, 1.0))
        .choice(&PclIcp::correspondences, "correspondences", "which pairs count",
                {{"nearest", Correspondences::nearest, "each source point with its nearest"},
                 {"reciprocal", Correspondences::reciprocal, "those nearest to each other"}})
        .reference("PCL 1.13: pcl::IterativeClosestPoint, IterativeClosestPointWithNormals")
        .reference("Canciani thesis, 3.2.2")
        .deterministic();
  }

  std::tuple<velum::Cloud, velum::Transform, velum::Table> operator()(
      const velum::Cloud& source, const velum::Cloud& target,
      const std::optional<velum::Transform>& initial, velum::Context& context) const {
    Borrowed run("PCL's ICP", source, target, initial, metric == Metric::point_to_point ? 3 : 6);
    if (metric == Metric::point_to_point) {
      pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> method;
      return align(method, velum::with_pcl::positions(run.source()),
                   velum::with_pcl::positions(run.target()), run, context);
    }
    pcl::IterativeClosestPointWithNormals<pcl::PointNormal, pcl::PointNormal> method;
    method.setUseSymmetricObjective(metric == Metric::symmetric);
    return align(method, velum::with_pcl::oriented(run.source()),
                 velum::with_pcl::oriented(run.target()), run, context);
  }

 private:
  template <class Point>
  std::tuple<velum::Cloud, velum::Transform, velum::Table> align(
      pcl::IterativeClosestPoint<Point, Point>& method,
      const std::shared_ptr<pcl::PointCloud<Point>>& from,
      const std::shared_ptr<pcl::PointCloud<Point>>& to, Borrowed& run,
      velum::Context& context) const {
    using Cloud = pcl::PointCloud<Point>;
    std::function<void(const Cloud&, const pcl::Indices&, const Cloud&, const pcl::Indices&)>
        watch = [&](const Cloud& moved, const pcl::Indices& source, const Cloud& target,
                    const pcl::Indices& match) {
          if (source.empty()) return;  // the call by which it is registered
          double squares = 0.0;
          for (std::size_t k = 0; k < source.size(); ++k) {
            const auto& p = moved[static_cast<std::size_t>(source[k])];
            const auto& q = target[static_cast<std::size_t>(match[k])];
            squares += static_cast<double>((p.getVector3fMap() - q.getVector3fMap()).squaredNorm());
          }
          run.iteration(velum::ConstPoints(velum::with_pcl::positions_of(moved).data(), 3,
                                           static_cast<velum::Index>(moved.size())),
                        static_cast<velum::Index>(source.size()),
                        squares / static_cast<double>(source.size()), context);
        };
    velum::with_pcl::quietly("PCL's ICP", [&] {
      method.setInputSource(from);
      method.setInputTarget(to);
      method.setMaximumIterations(iterations);
      method.setTransformationEpsilon(0.0);
      method.setTransformationRotationEpsilon(1.0);
      method.setEuclideanFitnessEpsilon(relative_change);
      method.setUseReciprocalCorrespondences(correspondences == Correspondences::reciprocal);
      if (max_distance) method.setMaxCorrespondenceDistance(*max_distance);
      method.registerVisualizationCallback(watch);
      Cloud moved;
      method.align(moved);
    });
    if (run.iterations() == 0 || !method.hasConverged())
      throw velum::Error(velum::Fault::stage, "PCL's ICP found too few pairs near enough")
          .hint(
              "bring the clouds closer first (registration.planes, registration.svd), or raise "
              "max_distance");
    return run.finish(method.getFinalTransformation().template cast<double>(),
                      max_distance ? static_cast<double>(*max_distance) : kInfinity,
                      run.iterations() < iterations, context);
  }
};

}  // namespace
VELUM_STAGE(PclIcp)
