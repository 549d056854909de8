// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <velum/stage.hpp>

#include "shapes/components.hpp"
#include "shapes/table.hpp"

namespace {

struct Euclidean {
  velum::Length distance = velum::spacings(4.0);
  int min_size = 100;
  std::optional<int> max_size;

  static auto about() {
    return velum::About<Euclidean>("Groups of points that lie apart from each other.")
        .in("cloud")
        .out("clusters", "numbered from the largest to the smallest")
        .param(&Euclidean::distance, "distance",
               "d_th: points at most this far apart are of one cluster", velum::above(0.0))
        .param(&Euclidean::min_size, "min_size", "smaller clusters are refused", velum::at_least(1))
        .param(&Euclidean::max_size, "max_size", "larger clusters are refused; unset: none is",
               velum::at_least(1))
        .deterministic()
        .reference("thesis 3.3.1: Algorithm 3.3");
  }

  void check() const {
    if (max_size.value_or(std::numeric_limits<int>::max()) < min_size)
      throw velum::Error(velum::Fault::graph,
                         fmt::format("max_size {} is below min_size {}", *max_size, min_size))
          .at("max_size");
  }

  velum::Clusters operator()(const velum::Cloud& cloud, velum::Context& context) const {
    const velum::Index most = max_size.value_or(std::numeric_limits<int>::max());
    // A cloud without extent has no spacing that a relative distance could follow.
    const double radius = distance > 0.0 ? distance.value : 1.0;
    const auto parts = velum::shapes::components(cloud.positions(), radius, context);
    velum::shapes::Labelled found{parts.labels, {}, {}};
    for (const velum::Index size : parts.sizes) {
      found.shapes.emplace_back();
      found.scores.push_back(static_cast<double>(size));
    }
    const velum::Index refused = velum::shapes::keep_sizes(found, min_size, most);
    velum::Clusters clusters = velum::shapes::clusters_of(cloud, std::move(found), context);
    velum::shapes::measure(clusters, context);
    context.measure("refused", static_cast<double>(refused), "");
    if (clusters.kinds.empty() && !cloud.empty())
      context.warn(
          fmt::format("none of {} groups has {} (min_size) to {} points; the largest has {}",
                      refused, min_size, most, parts.sizes.front()));
    return clusters;
  }
};

}  // namespace
VELUM_STAGE(Euclidean)
