// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "geometry/selection.hpp"

namespace {

struct RadiusOutliers {
  velum::Length radius;
  int min_neighbours = 5;

  static auto about() {
    return velum::About<RadiusOutliers>("Removes points with too few others around them.")
        .in("cloud")
        .out("cloud")
        .param(&RadiusOutliers::radius, "radius", "how far a neighbour may be", velum::above(0.0))
        .required()
        .param(&RadiusOutliers::min_neighbours, "min_neighbours",
               "other points within the radius that a point needs to stay", velum::at_least(1))
        .deterministic();
  }

  velum::Cloud operator()(const velum::Cloud& cloud, velum::Context& context) const {
    context.check();
    std::vector<std::uint8_t> keep(static_cast<std::size_t>(cloud.size()), 0);
    const velum::Index wanted = velum::Index{min_neighbours} + 1;
    const double limit = radius * radius;
    // The distance of the last neighbour that is needed decides: no need to count those within.
    cloud.neighbours().each_nearest(
        wanted, context, [&](velum::Index query, std::span<const velum::Neighbour> found) {
          keep[static_cast<std::size_t>(query)] =
              static_cast<velum::Index>(found.size()) == wanted &&
              static_cast<double>(found.back().distance2) <= limit;
        });
    return velum::geometry::keep_points(cloud, keep, context);
  }
};

}  // namespace
VELUM_STAGE(RadiusOutliers)
