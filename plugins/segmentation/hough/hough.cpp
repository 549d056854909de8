// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "shapes/hough.hpp"

#include <algorithm>
#include <numbers>
#include <velum/stage.hpp>

#include "shapes/parameters.hpp"
#include "shapes/table.hpp"

namespace {

using velum::shapes::Kind;

enum class Model { any, plane, sphere };

struct Hough {
  Model model = Model::plane;
  std::optional<velum::Length> epsilon;
  velum::Angle angle = {20.0 * std::numbers::pi / 180.0};
  std::optional<int> min_size;
  std::optional<int> shapes;
  velum::Length max_radius = velum::diagonals(0.5);
  velum::Length bin = velum::diagonals(0.01);
  int votes = 20000;
  bool edges = true;

  static auto about() {
    velum::About<Hough> about("Planes and spheres by the votes of a 3-D Hough transform.");
    about.in("cloud")
        .needs("cloud", "normals")
        .out("clusters", "numbered from the largest to the smallest")
        .choice(&Hough::model, "model", "which shapes are sought",
                {{"plane", Model::plane, "planes, for which flat patches vote"},
                 {"sphere", Model::sphere, "spheres, for which triples of points vote"},
                 {"any", Model::any, "both; the one that takes more points goes first"}});
    return velum::shapes::add_tolerances(about)
        .param(&Hough::shapes, "shapes", "most shapes to be found; unset: all", velum::at_least(1))
        .param(&Hough::max_radius, "max_radius", "greatest radius of a sphere", velum::above(0.0))
        .param(&Hough::bin, "bin", "cells of centre and radius in which votes for spheres meet",
               velum::above(0.0))
        .param(&Hough::votes, "votes", "triples of points that may vote for a sphere",
               velum::between(100, 10000000))
        .param(&Hough::edges, "edges",
               "points near an edge, whose normals are mixed, join the shape on which they lie")
        .seeded()
        .reference("thesis 3.3.4")
        .reference(
            "F. Limberger, M. Oliveira, Real-Time Detection of Planar Regions in Unorganized Point "
            "Clouds (2015)")
        .reference(
            "L. Xu, E. Oja, P. Kultanen, A new curve detection method: Randomized Hough "
            "transform (1990)");
  }

  velum::Clusters operator()(const velum::Cloud& cloud, velum::Context& context) const {
    velum::shapes::Search search;
    if (model != Model::sphere) search.kinds.push_back(Kind::plane);
    if (model != Model::plane) search.kinds.push_back(Kind::sphere);
    search.epsilon = velum::shapes::tolerance(epsilon, cloud, context);
    search.angle = angle;
    search.min_size = velum::shapes::least_points(min_size, cloud);
    search.most = shapes.value_or(search.most);
    search.max_radius = max_radius;
    search.edges = edges;
    const velum::shapes::Votes cast{votes, std::max(bin.value, 2.0 * search.epsilon)};

    velum::shapes::Detection found =
        cloud.diagonal() > 0.0
            ? velum::shapes::find_by_votes(cloud, search, cast, context)
            : velum::shapes::Detection{{}, Eigen::VectorXi::Constant(cloud.size(), -1), 0};
    velum::Clusters clusters =
        velum::shapes::clusters_of(cloud, velum::shapes::labelled(std::move(found)), context);
    velum::shapes::measure(clusters, context);
    velum::shapes::warn_of_nothing(clusters, "shape", search.min_size, search.epsilon, context);
    return clusters;
  }
};

}  // namespace
VELUM_STAGE(Hough)
