// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/overlap.hpp"

#include <velum/stage.hpp>

#include "geometry/selection.hpp"

namespace {

enum class Keep { shared, rest };

struct Overlap {
  velum::Length radius = velum::spacings(4);
  Keep keep = Keep::shared;

  static auto about() {
    return velum::About<Overlap>("Keeps the points of a cloud that another cloud has too, or not.")
        .in("cloud")
        .in("other", "in the same frame")
        .out("cloud", "points of `cloud` in their order, with all their columns")
        .param(&Overlap::radius, "radius",
               "a point with a point of `other` closer than this lies in the overlap",
               velum::above(0.0))
        .choice(&Overlap::keep, "keep", "which points stay",
                {{"shared", Keep::shared, "those in the overlap"},
                 {"rest", Keep::rest, "those outside it"}})
        .deterministic()
        .reference("thesis 3.2.3: Algorithm 3.2, step 8a");
  }

  velum::Cloud operator()(const velum::Cloud& cloud, const velum::Cloud& other,
                          velum::Context& context) const {
    context.check();
    // The kernel brings both to one origin, so that they differ by no motion.
    const std::vector<std::int32_t> shared =
        velum::registration::overlapping(cloud, other, velum::Pose::Identity(), radius, context);
    const auto points = static_cast<double>(cloud.size());
    context.measure("overlap", cloud.empty() ? 0.0 : static_cast<double>(shared.size()) / points,
                    "");
    std::vector<std::uint8_t> chosen(static_cast<std::size_t>(cloud.size()),
                                     keep == Keep::shared ? 0 : 1);
    for (const std::int32_t i : shared)
      chosen[static_cast<std::size_t>(i)] = keep == Keep::shared ? 1 : 0;
    return velum::geometry::keep_points(cloud, chosen, context);
  }
};

}  // namespace
VELUM_STAGE(Overlap)
