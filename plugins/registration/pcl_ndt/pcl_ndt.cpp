// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <pcl/registration/ndt.h>

#include <cmath>
#include <velum/stage.hpp>

#include "pcl/clouds.hpp"
#include "registration/borrowed.hpp"

namespace {

/// PCL numbers cells with 32 bits and leaves the cloud as it is when that is too few.
constexpr double kMostCells = 1e9;

struct PclNdt {
  velum::Length cell = velum::diagonals(0.05);
  velum::Length step = velum::diagonals(0.005);
  int iterations = 35;
  velum::Length still_shift = velum::diagonals(1e-4);
  double outlier_share = 0.55;
  int least_points = 6;
  std::optional<velum::Length> max_distance;

  static auto about() {
    return velum::About<PclNdt>("Normal distributions transform of the Point Cloud Library.")
        .in("source")
        .in("target")
        .in("initial", "where to start: source to target; without it the clouds as they are")
        .out("cloud", "the source in the target's frame")
        .out("transform", "source to target, with history")
        .out("table", "the history: one row an iteration")
        .param(&PclNdt::cell, "cell",
               "edge of the cells whose points make one distribution; also its reach",
               velum::above(0.0))
        .of("target")
        .param(&PclNdt::step, "step", "longest step of the line search", velum::above(0.0))
        .of("target")
        .param(&PclNdt::iterations, "iterations", "at most so many", velum::between(1, 10000))
        .param(&PclNdt::still_shift, "still_shift", "end when a step is shorter than this",
               velum::above(0.0))
        .of("target")
        .param(&PclNdt::outlier_share, "outlier_share", "of the points, expected",
               velum::Range{.low = 0.0, .high = 1.0, .low_open = true, .high_open = true})
        .param(&PclNdt::least_points, "least_points", "a cell with fewer makes no distribution",
               velum::between(3, 1000))
        .param(&PclNdt::max_distance, "max_distance",
               "pairs farther apart do not count in fitness and overlap", velum::above(0.0))
        .reference("PCL 1.13: pcl::NormalDistributionsTransform")
        .reference("Magnusson: The three-dimensional normal-distributions transform. PhD 2009")
        .deterministic();
  }

  std::tuple<velum::Cloud, velum::Transform, velum::Table> operator()(
      const velum::Cloud& source, const velum::Cloud& target,
      const std::optional<velum::Transform>& initial, velum::Context& context) const {
    velum::registration::Borrowed run("PCL's NDT", source, target, initial, least_points);
    require_cells(run.target());
    using Points = pcl::PointCloud<pcl::PointXYZ>;
    bool registered = false;
    std::function<void(const Points&, const pcl::Indices&, const Points&, const pcl::Indices&)>
        watch = [&](const Points& moved, const pcl::Indices&, const Points&, const pcl::Indices&) {
          if (!std::exchange(registered, true)) return;  // the call by which it is registered
          const velum::Points positions = velum::with_pcl::positions_of(moved);
          run.iteration(velum::ConstPoints(positions.data(), 3, positions.cols()), 0,
                        std::numeric_limits<double>::quiet_NaN(), context);
        };
    pcl::NormalDistributionsTransform<pcl::PointXYZ, pcl::PointXYZ> method;
    context.check();
    velum::with_pcl::quietly("PCL's NDT", [&] {
      method.setResolution(static_cast<float>(static_cast<double>(cell)));
      method.setMinPointPerVoxel(static_cast<unsigned>(least_points));
      method.setInputSource(velum::with_pcl::positions(run.source()));
      method.setInputTarget(velum::with_pcl::positions(run.target()));
      method.setStepSize(step);
      method.setOulierRatio(outlier_share);
      method.setMaximumIterations(iterations);
      method.setTransformationEpsilon(static_cast<double>(still_shift) *
                                      static_cast<double>(still_shift));
      method.registerVisualizationCallback(watch);
      Points moved;
      method.align(moved);
    });
    context.check();
    if (run.iterations() == 0)
      throw velum::Error(
          velum::Fault::stage,
          "PCL's NDT made no step: no source point is near a cell with enough points")
          .hint("bring the clouds closer first, or raise cell");
    const double limit =
        max_distance ? static_cast<double>(*max_distance) : std::numeric_limits<double>::infinity();
    return run.finish(method.getFinalTransformation().cast<double>(), limit,
                      run.iterations() < iterations, context);
  }

 private:
  void require_cells(const velum::Cloud& target) const {
    const Eigen::Vector3d extent =
        velum::bounding_box(target.positions()).sizes().cast<double>() / static_cast<double>(cell);
    const double cells = (extent.array() + 1.0).prod();
    if (!(cells < kMostCells))
      throw velum::Error(
          velum::Fault::stage,
          fmt::format("the target needs {:.3g} cells of {:.6g} m, PCL's NDT can number {:.0g}",
                      cells, static_cast<double>(cell), kMostCells))
          .hint("raise cell");
  }
};

}  // namespace
VELUM_STAGE(PclNdt)
