// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "deviation/surface.hpp"

#include <cmath>

#include "deviation/statistics.hpp"
#include "geometry/normals.hpp"

namespace velum::deviation {

Cloud with_surface(const Cloud& cloud, std::optional<double> radius, Context& context) {
  if (!radius && cloud.has(column::kNormals) && cloud.has(column::kCurvature) &&
      cloud.normals().allFinite() && cloud.curvature().allFinite())
    return cloud;
  geometry::NormalOptions options;
  options.radius = radius;
  geometry::NormalField field = geometry::estimate_normals(cloud, options, context);
  return cloud.with(column::kNormals, Column(std::move(field.normals)))
      .with(column::kCurvature, Column(std::move(field.curvature)));
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

Cloud with_columns(const Cloud& cloud, const Deviations& found) {
  return cloud.with("distance", Column(found.distance))
      .with("normal_deviation", Column(found.normal))
      .with("curvature_difference", Column(found.curvature));
}

Table report_all(const Deviations& found, int bins, double limit, Context& context) {
  report(statistics(found.distance), "", "m", context);
  report(statistics(found.normal), "normal_", "rad", context);
  report(statistics(found.curvature), "curvature_", "", context);
  Table table = histogram_table();
  add_histogram(table, "distance", "m", found.distance, bins, limit);
  add_histogram(table, "normal_deviation", "rad", found.normal, bins, 0.0);
  add_histogram(table, "curvature_difference", "", found.curvature, bins, 0.0);
  return table;
}

}  // namespace velum::deviation
