// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <velum/stage.hpp>

#include "geometry/selection.hpp"

namespace {

struct StatisticalOutliers {
  int neighbours = 50;
  double deviations = 2.0;

  static auto about() {
    return velum::About<StatisticalOutliers>(
               "Removes points whose mean distance to their neighbours is out of the ordinary.")
        .in("cloud")
        .out("cloud")
        .param(&StatisticalOutliers::neighbours, "neighbours",
               "other points that the mean distance of a point is taken over", velum::at_least(1))
        .param(&StatisticalOutliers::deviations, "deviations",
               "standard deviations above the cloud's mean that are still ordinary",
               velum::at_least(0.0))
        .deterministic()
        .reference("R. B. Rusu et al., Towards 3D Point Cloud Based Object Maps (2008)");
  }

  velum::Cloud operator()(const velum::Cloud& cloud, velum::Context& context) const {
    context.check();
    const Eigen::VectorXd distances = mean_distances(cloud, context);
    const double limit = ordinary_distance(distances, context);
    context.measure("limit", limit, "m");
    std::vector<std::uint8_t> keep(static_cast<std::size_t>(cloud.size()));
    for (std::size_t i = 0; i < keep.size(); ++i)
      keep[i] = distances[static_cast<velum::Index>(i)] <= limit;
    return velum::geometry::keep_points(cloud, keep, context);
  }

 private:
  [[nodiscard]] Eigen::VectorXd mean_distances(const velum::Cloud& cloud,
                                               velum::Context& context) const {
    Eigen::VectorXd distances(cloud.size());
    cloud.neighbours().each_nearest(
        velum::Index{neighbours} + 1, context,
        [&](velum::Index query, std::span<const velum::Neighbour> found) {
          double sum = 0.0;
          for (const velum::Neighbour& n : found) sum += std::sqrt(n.distance2);
          const auto others = static_cast<double>(found.size()) - 1.0;
          distances[query] = others > 0.0 ? sum / others : 0.0;
        });
    return distances;
  }

  // Mean plus so many standard deviations. Summed in the order of the points, so that the limit
  // does not depend on the threads.
  [[nodiscard]] double ordinary_distance(const Eigen::VectorXd& distances,
                                         velum::Context& context) const {
    if (distances.size() == 0) return 0.0;
    double sum = 0.0;
    for (const double d : distances) sum += d;
    const double mean = sum / static_cast<double>(distances.size());
    double squares = 0.0;
    for (const double d : distances) squares += (d - mean) * (d - mean);
    const double freedoms = std::max<double>(static_cast<double>(distances.size()) - 1.0, 1.0);
    const double sd = std::sqrt(squares / freedoms);
    context.measure("mean_distance", mean, "m");
    // A rounding's worth of slack keeps every point of a perfectly regular cloud.
    return mean + deviations * sd + 1e-6 * mean;
  }
};

}  // namespace
VELUM_STAGE(StatisticalOutliers)
