// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <velum/stage.hpp>

#include "geometry/selection.hpp"

namespace {

struct RemovePoints {
  std::vector<velum::Place> points;
  std::optional<velum::Length> radius;
  std::vector<int> indices;
  std::vector<int> labels;

  static auto about() {
    return velum::About<RemovePoints>("Removes picked points, by place, number or label.")
        .in("cloud")
        .out("cloud")
        .param(&RemovePoints::points, "points", "picked places, in the cloud's frame")
        .param(&RemovePoints::radius, "radius",
               "all points this near to a picked place are removed; unset: the nearest one alone",
               velum::above(0.0))
        .param(&RemovePoints::indices, "indices", "numbers of points, from 0", velum::at_least(0))
        .param(&RemovePoints::labels, "labels", "values of the column label")
        .deterministic()
        .reference("thesis 4.2: elimination of picked points");
  }

  void check() const {
    if (radius && points.empty())
      throw velum::Error(velum::Fault::graph, "'radius' is about 'points', which are not given")
          .at("radius");
  }

  velum::Cloud operator()(const velum::Cloud& cloud, velum::Context& context) const {
    context.check();
    if (points.empty() && indices.empty() && labels.empty())
      context.warn("nothing is said to be removed: neither points, indices nor labels are given");
    std::vector<std::uint8_t> keep(static_cast<std::size_t>(cloud.size()), 1);
    if (!cloud.empty()) {
      drop_places(cloud, keep);
      drop_indices(cloud, keep);
      drop_labels(cloud, keep);
    }
    return velum::geometry::keep_points(cloud, keep, context);
  }

 private:
  void drop_places(const velum::Cloud& cloud, std::vector<std::uint8_t>& keep) const {
    std::vector<velum::Neighbour> found;
    for (const velum::Place& place : points) {
      const Eigen::Vector3f query = (place.metres - cloud.origin()).cast<float>();
      if (radius)
        cloud.neighbours().within(query, *radius, found);
      else
        cloud.neighbours().nearest(query, 1, found);
      for (const velum::Neighbour& n : found) keep[static_cast<std::size_t>(n.index)] = 0;
    }
  }
  void drop_indices(const velum::Cloud& cloud, std::vector<std::uint8_t>& keep) const {
    for (const int index : indices) {
      if (index >= cloud.size())
        throw velum::Error(velum::Fault::stage,
                           fmt::format("point {} was to be removed, but the cloud has {} (from 0)",
                                       index, cloud.size()));
      keep[static_cast<std::size_t>(index)] = 0;
    }
  }
  void drop_labels(const velum::Cloud& cloud, std::vector<std::uint8_t>& keep) const {
    if (labels.empty()) return;
    const auto values = cloud.labels();
    for (velum::Index i = 0; i < cloud.size(); ++i)
      if (std::find(labels.begin(), labels.end(), values[i]) != labels.end())
        keep[static_cast<std::size_t>(i)] = 0;
  }
};

}  // namespace
VELUM_STAGE(RemovePoints)
