// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#define CGAL_EIGEN3_ENABLED 1
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/jet_smooth_point_set.h>

#include <functional>
#include <velum/stage.hpp>

#include "smoothing/library.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

struct CgalJet {
  int neighbours = 24;
  int degree = 2;

  static auto about() {
    return velum::About<CgalJet>("Smoothing by local jets, of CGAL.")
        .in("cloud")
        .out("cloud")
        .param(&CgalJet::neighbours, "neighbours", "points that a jet is fitted to",
               velum::between(3, 1000))
        .param(&CgalJet::degree, "degree", "of the polynomial", velum::between(1, 4))
        .deterministic()
        .reference(
            "F. Cazals and M. Pouget, Estimating differential quantities using polynomial fitting "
            "of osculating jets, Computer Aided Geometric Design 22 (2005)")
        .licence("GPL-3.0-or-later");
  }

  /// Coefficients of the polynomial.
  [[nodiscard]] int terms() const { return (degree + 1) * (degree + 2) / 2; }

  void check() const {
    if (neighbours < terms())
      throw velum::Error(velum::Fault::graph, "a jet of degree " + std::to_string(degree) +
                                                  " needs at least " + std::to_string(terms()) +
                                                  " neighbours, not " + std::to_string(neighbours))
          .at("neighbours");
  }

  velum::Cloud operator()(const velum::Cloud& cloud, velum::Context& context) const {
    context.check();
    if (cloud.size() <= terms() || !(cloud.diagonal() > 0.0)) {
      context.warn("too few points for a jet: nothing is moved");
      return velum::smoothing::moved(cloud, velum::Points(cloud.positions()), context);
    }
    const Eigen::Vector3d centre = velum::smoothing::centre_of(cloud);
    std::vector<Kernel::Point_3> points;
    for (velum::Index i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d at = cloud.positions().col(i).cast<double>() - centre;
      points.emplace_back(at.x(), at.y(), at.z());
    }
    const auto most =
        static_cast<unsigned int>(std::min<velum::Index>(neighbours, cloud.size() - 1));
    // By reference: CGAL 5.5 keeps one to a copy that is gone.
    const std::function<bool(double)> report = velum::smoothing::progress(context);
    velum::smoothing::guarded("CGAL's jet smoothing", [&] {
      CGAL::jet_smooth_point_set<CGAL::Sequential_tag>(
          points, most,
          CGAL::parameters::degree_fitting(static_cast<unsigned int>(degree))
              .degree_monge(static_cast<unsigned int>(std::min(degree, 2)))
              .callback(std::cref(report)));
    });
    context.check();
    velum::Points positions(3, cloud.size());
    for (velum::Index i = 0; i < positions.cols(); ++i) {
      const Kernel::Point_3& p = points[static_cast<std::size_t>(i)];
      positions.col(i) = (centre + Eigen::Vector3d(p.x(), p.y(), p.z())).cast<float>();
    }
    return velum::smoothing::moved(cloud, std::move(positions), context);
  }
};

}  // namespace
VELUM_STAGE(CgalJet)
