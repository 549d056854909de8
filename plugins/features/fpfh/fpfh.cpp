// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "features/histograms.hpp"

namespace {

constexpr double kSpacings = 6.0;
constexpr velum::Index kNeighbours = 100;

struct Fpfh {
  std::optional<int> neighbours;
  std::optional<velum::Length> radius;

  static auto about() {
    return velum::About<Fpfh>(
               "Fast point feature histograms: what the surface around each point "
               "looks like, in 33 numbers.")
        .in("cloud")
        .out("cloud")
        .needs("cloud", "normals")
        .adds("cloud", "fpfh")
        .param(&Fpfh::neighbours, "neighbours",
               "points of a neighbourhood, the point itself among them; with neither this nor "
               "radius: all within 6 spacings, at most 100",
               velum::at_least(2))
        .param(&Fpfh::radius, "radius",
               "radius of a neighbourhood; with neighbours: at most that many within it",
               velum::above(0.0))
        .reference("Canciani thesis, 3.1.6")
        .reference("Rusu, Blodow, Beetz: Fast point feature histograms for 3D registration. 2009")
        .deterministic();
  }

  velum::Cloud operator()(const velum::Cloud& cloud, velum::Context& context) const {
    velum::features::Neighbourhood around;
    if (neighbours) around.neighbours = *neighbours;
    if (radius) around.radius = *radius;
    if (!neighbours && !radius) around = {kNeighbours, kSpacings * cloud.spacing()};
    Eigen::MatrixXf histograms = velum::features::fpfh(cloud, around, context);
    const auto empty = (histograms.colwise().squaredNorm().array() == 0.0F).count();
    context.measure("empty", static_cast<double>(empty), "", velum::Better::lower);
    return cloud.with("fpfh", velum::Column(std::move(histograms)));
  }
};

}  // namespace
VELUM_STAGE(Fpfh)
