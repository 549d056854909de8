// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/wlop_simplify_and_regularize_point_set.h>

#include <cmath>
#include <functional>
#include <velum/stage.hpp>

#include "smoothing/library.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using velum::Cloud;
using velum::Index;

struct CgalWlop {
  double share = 0.2;
  std::optional<velum::Length> radius;
  int iterations = 35;
  bool uneven = false;

  static auto about() {
    return velum::About<CgalWlop>(
               "Fewer, evenly spread and smoothed points: weighted locally optimal projection, of "
               "CGAL.")
        .in("cloud")
        .out("cloud", "new points with the columns of the nearest old ones")
        .param(&CgalWlop::share, "share", "points of the result, of those given",
               velum::Range{.low = 0.0, .high = 1.0, .low_open = true})
        .param(&CgalWlop::radius, "radius",
               "of the neighbourhood that attracts and spreads points; unset: eight times the "
               "spacing",
               velum::above(0.0))
        .param(&CgalWlop::iterations, "iterations", "rounds", velum::between(1, 1000))
        .param(&CgalWlop::uneven, "uneven",
               "weigh the given points by their density first: better where it varies much")
        .deterministic()
        .reference(
            "H. Huang et al., Consolidation of unorganized point clouds for surface "
            "reconstruction, ACM Transactions on Graphics 28 (2009)")
        .licence("GPL-3.0-or-later");
  }

  Cloud operator()(const Cloud& cloud, velum::Context& context) const {
    context.check();
    const double wide = radius ? radius->value : 8.0 * cloud.spacing();
    if (cloud.size() < 3 || !(cloud.diagonal() > 0.0) || !(wide > 0.0)) {
      context.warn("too few points to project: the cloud is returned as it is");
      report(cloud.size(), cloud.size(), context);
      return cloud;
    }
    const Eigen::Vector3d centre = velum::smoothing::centre_of(cloud);
    std::vector<Kernel::Point_3> made;
    project(cloud, centre, wide, made, context);
    context.check();
    velum::Points positions(3, static_cast<Index>(made.size()));
    Index count = 0;
    for (const Kernel::Point_3& p : made)
      if (std::isfinite(p.x() + p.y() + p.z()))
        positions.col(count++) = (centre + Eigen::Vector3d(p.x(), p.y(), p.z())).cast<float>();
    positions.conservativeResize(3, count);
    report(cloud.size(), count, context);
    return with_columns(cloud, std::move(positions), context);
  }

 private:
  void project(const Cloud& cloud, const Eigen::Vector3d& centre, double wide,
               std::vector<Kernel::Point_3>& made, velum::Context& context) const {
    std::vector<Kernel::Point_3> points;
    for (velum::Index i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d at = cloud.positions().col(i).cast<double>() - centre;
      points.emplace_back(at.x(), at.y(), at.z());
    }
    // CGAL takes the whole part of share · n; one point at least.
    const double least = 1.0001 / static_cast<double>(cloud.size());
    // By reference: CGAL 5.5 keeps one to a copy that is gone.
    const std::function<bool(double)> report = velum::smoothing::progress(context);
    velum::smoothing::guarded("CGAL's WLOP", [&] {
      CGAL::wlop_simplify_and_regularize_point_set<CGAL::Sequential_tag>(
          points, std::back_inserter(made),
          CGAL::parameters::select_percentage(100.0 * std::min(1.0, std::max(share, least)))
              .neighbor_radius(wide)
              .number_of_iterations(static_cast<unsigned int>(iterations))
              .require_uniform_sampling(uneven)
              .callback(std::cref(report)));
    });
  }

  static Cloud with_columns(const Cloud& cloud, velum::Points positions, velum::Context& context) {
    std::vector<std::int32_t> nearest(static_cast<std::size_t>(positions.cols()));
    const velum::ConstPoints view(positions.data(), 3, positions.cols());
    cloud.neighbours().each_nearest(view, 1, context,
                                    [&](Index i, std::span<const velum::Neighbour> found) {
                                      nearest[static_cast<std::size_t>(i)] = found.front().index;
                                    });
    return cloud.select(nearest).with_positions(std::move(positions));
  }

  static void report(Index before, Index after, velum::Context& context) {
    context.measure("kept", static_cast<double>(after), "");
    context.measure(
        "share", before > 0 ? static_cast<double>(after) / static_cast<double>(before) : 0.0, "");
  }
};

}  // namespace
VELUM_STAGE(CgalWlop)
