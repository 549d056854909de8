// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "features/histograms.hpp"

namespace {

constexpr double kSpacings = 4.0;
constexpr velum::Index kNeighbours = 40;

struct Pfh {
  std::optional<int> neighbours;
  std::optional<velum::Length> radius;

  static auto about() {
    return velum::About<Pfh>(
               "Point feature histograms: what the surface around each point looks "
               "like, from all pairs of its neighbours, in 125 numbers.")
        .in("cloud")
        .out("cloud")
        .needs("cloud", "normals")
        .adds("cloud", "pfh")
        .param(&Pfh::neighbours, "neighbours",
               "points of a neighbourhood, the point itself among them; time grows with its "
               "square; with neither this nor radius: all within 4 spacings, at most 40",
               velum::between(2, 2000))
        .param(&Pfh::radius, "radius",
               "radius of a neighbourhood; with neighbours: at most that many within it",
               velum::above(0.0))
        .reference("Canciani thesis, 3.1.5, equation 3.4")
        .reference("R. B. Rusu, Semantic 3D Object Maps (2010)")
        .deterministic();
  }

  velum::Cloud operator()(const velum::Cloud& cloud, velum::Context& context) const {
    velum::features::Neighbourhood around;
    if (neighbours) around.neighbours = *neighbours;
    if (radius) around.radius = *radius;
    if (!neighbours && !radius) around = {kNeighbours, kSpacings * cloud.spacing()};
    Eigen::MatrixXf histograms = velum::features::pfh(cloud, around, context);
    const auto empty = (histograms.colwise().squaredNorm().array() == 0.0F).count();
    context.measure("empty", static_cast<double>(empty), "", velum::Better::lower);
    return cloud.with("pfh", velum::Column(std::move(histograms)));
  }
};

}  // namespace
VELUM_STAGE(Pfh)
