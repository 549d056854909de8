// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <velum/values.hpp>

#include "shapes/ransac.hpp"

namespace velum::shapes {

/// Labels 0 ... n-1 over a cloud, and what is known of each: a shape relative to the cloud's origin
/// or none (a region without a model), and the method's own score.
struct Labelled {
  Eigen::VectorXi labels;
  std::vector<std::optional<Shape>> shapes;
  std::vector<double> scores;
};
Labelled labelled(Detection detection);

/// Clusters with one row each in `kinds`: cluster, points, model ("plane", "sphere", "cylinder",
/// "cone" or "region"), score, rms [m], point_x/y/z [m, absolute] (centroid of a plane or region,
/// centre of a sphere, middle of a cylinder's axis, apex of a cone), axis_x/y/z (normal of a plane
/// and of a region's best plane, axis of a cylinder, from the apex into a cone; 0 of a sphere),
/// radius [m], angle [rad] between a cone's axis and side, and length, width, depth [m], the extent
/// along the principal axes.
Clusters clusters_of(const Cloud& cloud, Labelled found, Context& context);

/// Numbers clusters from the largest (0) down and refuses those out of [least, most]; returns how
/// many were refused.
Index keep_sizes(Labelled& found, Index least, Index most);

/// Measures `clusters`, `assigned` (share of the points) and `largest` (points).
void measure(const Clusters& clusters, Context& context);

}  // namespace velum::shapes
