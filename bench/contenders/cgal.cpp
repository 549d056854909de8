// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/compute_average_spacing.h>
#include <CGAL/jet_smooth_point_set.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/remove_outliers.h>

#include <array>

#include "timing.hpp"

namespace bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using PointNormal = std::pair<Point, Kernel::Vector_3>;

std::vector<Point> convert(const velum::Cloud& cloud) {
  std::vector<Point> out;
  const auto p = cloud.positions();
  for (velum::Index i = 0; i < p.cols(); ++i) out.emplace_back(p(0, i), p(1, i), p(2, i));
  return out;
}

std::function<void()> normals(const Input& input) {
  std::vector<PointNormal> pairs;
  for (const Point& p : convert(input.cloud)) pairs.emplace_back(p, Kernel::Vector_3());
  return [pairs]() mutable {
    CGAL::pca_estimate_normals<CGAL::Sequential_tag>(
        pairs, 50,
        CGAL::parameters::point_map(CGAL::First_of_pair_property_map<PointNormal>())
            .normal_map(CGAL::Second_of_pair_property_map<PointNormal>()));
  };
}

std::function<void()> statistical(const Input& input) {
  return [points = convert(input.cloud)]() mutable {
    CGAL::remove_outliers<CGAL::Sequential_tag>(points, 50,
                                                CGAL::parameters::threshold_percent(5.0));
  };
}

std::function<void()> jet_smoothing(const Input& input) {
  return [points = convert(input.cloud)]() mutable {
    CGAL::jet_smooth_point_set<CGAL::Sequential_tag>(points, 50);
  };
}

std::function<void()> advancing_front(const Input& input) {
  return [points = convert(input.smooth)] {
    std::vector<std::array<std::size_t, 3>> facets;
    CGAL::advancing_front_surface_reconstruction(points.begin(), points.end(),
                                                 std::back_inserter(facets));
  };
}

}  // namespace

std::vector<Contender> cgal_contenders() {
  return {
      {"normals, k = 50", "CGAL", normals},
      {"statistical outliers, k = 50", "CGAL", statistical},
      {"MLS, order 2", "CGAL jet", jet_smoothing},
      {"meshing", "CGAL advancing front", advancing_front},
  };
}

}  // namespace bench
