// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "shapes/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/normals.hpp"

namespace velum::shapes {

double tolerance(const std::optional<Length>& epsilon, const Cloud& cloud, Context& context) {
  const double metres = epsilon ? epsilon->value
                                : std::max({6.0 * geometry::estimate_noise(cloud, context),
                                            0.1 * cloud.spacing(), 1e-6 * cloud.diagonal()});
  context.measure("epsilon", metres, "m");
  return metres;
}

int least_points(const std::optional<int>& min_size, const Cloud& cloud) {
  return min_size.value_or(std::max(50, static_cast<int>(cloud.size() / 100)));
}

void warn_of_nothing(const Clusters& clusters, std::string_view what, Index min_size,
                     double epsilon, Context& context) {
  if (clusters.kinds.empty() && !clusters.cloud.empty())
    context.warn(fmt::format("no {} of {} points (min_size) lies within {:.3g} m (epsilon)", what,
                             min_size, epsilon));
}

}  // namespace velum::shapes
