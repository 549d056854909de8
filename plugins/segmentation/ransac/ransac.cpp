// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "shapes/ransac.hpp"

#include <algorithm>
#include <numbers>
#include <velum/stage.hpp>

#include "shapes/parameters.hpp"
#include "shapes/table.hpp"

namespace {

using velum::shapes::Kind;

enum class Model { any, plane, sphere, cylinder, cone };

struct Ransac {
  Model model = Model::any;
  std::optional<velum::Length> epsilon;
  velum::Angle angle = {20.0 * std::numbers::pi / 180.0};
  std::optional<int> min_size;
  std::optional<int> shapes;
  double overlook = 0.01;
  velum::Length max_radius = velum::diagonals(0.5);
  std::optional<velum::Length> gap;
  bool edges = true;

  static auto about() {
    velum::About<Ransac> about("Planes, spheres, cylinders and cones, one after another.");
    about.in("cloud")
        .needs("cloud", "normals")
        .out("clusters", "numbered from the largest to the smallest")
        .choice(&Ransac::model, "model", "which shapes are sought",
                {{"any", Model::any, "all four; the simplest that explains the points is taken"},
                 {"plane", Model::plane, "planes only"},
                 {"sphere", Model::sphere, "spheres only"},
                 {"cylinder", Model::cylinder, "cylinders only"},
                 {"cone", Model::cone, "cones only"}});
    return velum::shapes::add_tolerances(about)
        .param(&Ransac::shapes, "shapes", "most shapes to be found; unset: all", velum::at_least(1))
        .param(&Ransac::max_radius, "max_radius", "greatest radius of a sphere or cylinder",
               velum::above(0.0))
        .param(&Ransac::gap, "gap",
               "a wider gap parts a shape, of which the largest part is taken first; unset: parts "
               "may lie apart",
               velum::above(0.0))
        .param(&Ransac::edges, "edges",
               "points near an edge, whose normals are mixed, join the shape on which they lie")
        .param(&Ransac::overlook, "overlook",
               "chance of missing a shape of min_size points; less takes longer",
               velum::between(1e-9, 0.5))
        .advanced()
        .seeded()
        .reference("thesis 3.3.2: Algorithm 3.4, tables 3.24 and 3.25")
        .reference(
            "R. Schnabel, R. Wahl, R. Klein, Efficient RANSAC for Point-Cloud Shape Detection "
            "(2007)");
  }

  velum::Clusters operator()(const velum::Cloud& cloud, velum::Context& context) const {
    velum::shapes::Search search;
    if (model == Model::any)
      search.kinds.assign(velum::shapes::kAllKinds.begin(), velum::shapes::kAllKinds.end());
    else
      search.kinds = {static_cast<Kind>(static_cast<int>(model) - 1)};
    search.epsilon = velum::shapes::tolerance(epsilon, cloud, context);
    search.angle = angle;
    search.min_size = velum::shapes::least_points(min_size, cloud);
    search.most = shapes.value_or(search.most);
    search.overlook = overlook;
    search.max_radius = max_radius;
    search.gap = gap ? gap->value : 0.0;
    search.edges = edges;

    velum::shapes::Detection found = velum::shapes::find_shapes(cloud, search, context);
    context.measure("samples", static_cast<double>(found.samples), "");
    velum::Clusters clusters =
        velum::shapes::clusters_of(cloud, velum::shapes::labelled(std::move(found)), context);
    velum::shapes::measure(clusters, context);
    velum::shapes::warn_of_nothing(clusters, "shape", search.min_size, search.epsilon, context);
    return clusters;
  }
};

}  // namespace
VELUM_STAGE(Ransac)
