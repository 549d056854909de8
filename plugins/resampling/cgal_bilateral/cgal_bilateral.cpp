// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/bilateral_smooth_point_set.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <velum/stage.hpp>

#include "smoothing/library.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Oriented = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using velum::Cloud;
using velum::Index;

struct CgalBilateral {
  int neighbours = 48;
  velum::Angle sharpness{25.0 * std::numbers::pi / 180.0};
  int iterations = 1;

  static auto about() {
    return velum::About<CgalBilateral>("Bilateral smoothing that keeps creases, of CGAL.")
        .in("cloud")
        .out("cloud")
        .needs("cloud", "normals")
        .param(&CgalBilateral::neighbours, "neighbours", "points around each that count",
               velum::between(2, 1000))
        .param(&CgalBilateral::sharpness, "sharpness",
               "normals that differ by more belong to another face; larger is smoother",
               velum::between(0.01, 1.5))
        .param(&CgalBilateral::iterations, "iterations", "rounds", velum::between(1, 100))
        .deterministic()
        .reference(
            "H. Huang et al., Edge-aware point set resampling, ACM Transactions on Graphics 32 "
            "(2013)")
        .licence("GPL-3.0-or-later");
  }

  Cloud operator()(const Cloud& cloud, velum::Context& context) const {
    context.check();
    require_unit_normals(cloud);
    const Eigen::Vector3d centre = velum::smoothing::centre_of(cloud);
    if (cloud.size() < 3 || !(cloud.diagonal() > 0.0)) {
      context.warn("too few points to smooth: nothing is moved");
      return velum::smoothing::moved(cloud, velum::Points(cloud.positions()), context);
    }
    std::vector<Oriented> points = oriented(cloud, centre);
    const auto most = static_cast<unsigned int>(std::min<Index>(neighbours, cloud.size() - 1));
    for (int round = 0; round < iterations; ++round) {
      // By reference: CGAL 5.5 keeps one to a copy that is gone.
      const std::function<bool(double)> report = [&](double) { return !context.cancelled(); };
      velum::smoothing::guarded("CGAL's bilateral smoothing", [&] {
        CGAL::bilateral_smooth_point_set<CGAL::Sequential_tag>(
            points, most,
            CGAL::parameters::point_map(CGAL::First_of_pair_property_map<Oriented>())
                .normal_map(CGAL::Second_of_pair_property_map<Oriented>())
                .sharpness_angle(sharpness.radians * 180.0 / std::numbers::pi)
                .callback(std::cref(report)));
      });
      context.check();
      context.progress((round + 1.0) / iterations);
      if (!mend(points, cloud, centre)) break;
    }
    return smoothed(cloud, points, centre, context);
  }

 private:
  static void require_unit_normals(const Cloud& cloud) {
    for (Index i = 0; i < cloud.size(); ++i) {
      const float length = cloud.normals().col(i).norm();
      if (!(std::abs(length - 1.0F) < 0.01F))
        throw velum::Error(velum::Fault::stage,
                           "the normal of point " + std::to_string(i) + " is not of unit length")
            .hint("make normals by features.normals");
    }
  }

  static std::vector<Oriented> oriented(const Cloud& cloud, const Eigen::Vector3d& centre) {
    std::vector<Oriented> points;
    for (Index i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d p = cloud.positions().col(i).cast<double>() - centre;
      const Eigen::Vector3d n = cloud.normals().col(i).cast<double>();
      points.emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()),
                          Kernel::Vector_3(n.x(), n.y(), n.z()));
    }
    return points;
  }

  // A point that CGAL lost (its neighbours weigh nothing) goes back to where it was, so that it
  // does not spoil the next round. False when all were lost.
  static bool mend(std::vector<Oriented>& points, const Cloud& cloud,
                   const Eigen::Vector3d& centre) {
    std::size_t lost = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& [p, n] = points[i];
      const double length = std::sqrt(n.squared_length());
      if (std::isfinite(p.x() + p.y() + p.z()) && std::isfinite(length) && length > 1e-6) {
        points[i].second = n / length;
        continue;
      }
      ++lost;
      const auto slot = static_cast<Index>(i);
      const Eigen::Vector3d at = cloud.positions().col(slot).cast<double>() - centre;
      const Eigen::Vector3d normal = cloud.normals().col(slot).cast<double>();
      points[i] = {Kernel::Point_3(at.x(), at.y(), at.z()),
                   Kernel::Vector_3(normal.x(), normal.y(), normal.z())};
    }
    return lost < points.size();
  }

  static Cloud smoothed(const Cloud& cloud, const std::vector<Oriented>& points,
                        const Eigen::Vector3d& centre, velum::Context& context) {
    velum::Points positions(3, cloud.size());
    velum::Points normals(3, cloud.size());
    for (Index i = 0; i < cloud.size(); ++i) {
      const auto& [p, n] = points[static_cast<std::size_t>(i)];
      positions.col(i) = (centre + Eigen::Vector3d(p.x(), p.y(), p.z())).cast<float>();
      normals.col(i) = Eigen::Vector3d(n.x(), n.y(), n.z()).cast<float>();
    }
    return velum::smoothing::moved(cloud, std::move(positions), context)
        .with(velum::column::kNormals, velum::Column(std::move(normals)));
  }
};

}  // namespace
VELUM_STAGE(CgalBilateral)
