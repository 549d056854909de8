// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "deviation/statistics.hpp"
#include "deviation/surface.hpp"

namespace {

using velum::Cloud;
using velum::Context;
using velum::Index;
using Found = std::span<const velum::Neighbour>;

// Distances from the reference's points to the cloud.
Eigen::VectorXf back_distances(const Cloud& cloud, const Cloud& reference, Context& context) {
  Eigen::VectorXf distance(reference.size());
  cloud.neighbours().each_nearest(reference.positions(), 1, context, [&](Index i, Found found) {
    distance[i] = std::sqrt(found.front().distance2);
  });
  return distance;
}

struct CloudToCloud {
  std::optional<velum::Length> radius;
  int bins = 20;
  std::optional<velum::Length> limit;

  static auto about() {
    return velum::About<CloudToCloud>(
               "Distance, normal deviation and curvature difference from each point to the nearest "
               "point of a reference.")
        .in("cloud", "what is judged")
        .in("reference", "what it should be")
        .out("table", "histograms")
        .out("cloud", "the input with a column for each deviation")
        .adds("cloud", "distance")
        .adds("cloud", "normal_deviation")
        .adds("cloud", "curvature_difference")
        .param(&CloudToCloud::radius, "radius",
               "neighbourhood from which normals and curvature of both clouds are made; unset: the "
               "columns that they have, or a neighbourhood chosen point by point",
               velum::above(0.0))
        .param(&CloudToCloud::bins, "bins", "ranges of each histogram", velum::between(1, 1000))
        .param(&CloudToCloud::limit, "limit",
               "end of the distances' histogram; unset: the greatest distance", velum::above(0.0))
        .deterministic()
        .reference("thesis 3.2.2, figure 3.22; thesis 3.4, figure 3.51");
  }

  std::tuple<velum::Table, Cloud> operator()(const Cloud& cloud, const Cloud& reference,
                                             Context& context) const {
    context.check();
    if (cloud.empty() || reference.empty())
      throw velum::Error(velum::Fault::stage,
                         std::string(cloud.empty() ? "the cloud" : "the reference") +
                             " has no points: there is no distance");
    const auto own = velum::deviation::with_surface(cloud, neighbourhood(), context);
    context.progress(0.4);
    const auto other = velum::deviation::with_surface(reference, neighbourhood(), context);
    context.progress(0.8);
    const auto found = compare(own, other, context);
    velum::Table table =
        velum::deviation::report_all(found, bins, limit ? limit->value : 0.0, context);
    const auto back = velum::deviation::statistics(back_distances(cloud, reference, context));
    context.measure("back_rms", back.rms, "m", velum::Better::lower);
    context.measure("hausdorff", std::max(back.max, static_cast<double>(found.distance.maxCoeff())),
                    "m", velum::Better::lower);
    return {std::move(table), velum::deviation::with_columns(cloud, found)};
  }

 private:
  [[nodiscard]] std::optional<double> neighbourhood() const {
    return radius ? std::optional<double>(*radius) : std::nullopt;
  }

  static velum::deviation::Deviations compare(const Cloud& cloud, const Cloud& reference,
                                              Context& context) {
    velum::deviation::Deviations found(cloud.size());
    reference.neighbours().each_nearest(cloud.positions(), 1, context, [&](Index i, Found nearest) {
      const Index other = nearest.front().index;
      found.distance[i] = std::sqrt(nearest.front().distance2);
      found.normal[i] = static_cast<float>(velum::deviation::angle_between(
          cloud.normals().col(i).cast<double>(), reference.normals().col(other).cast<double>()));
      found.curvature[i] = std::abs(cloud.curvature()[i] - reference.curvature()[other]);
    });
    return found;
  }
};

}  // namespace
VELUM_STAGE(CloudToCloud)
