// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/bilateral_smooth_point_set.h>
#include <CGAL/jet_smooth_point_set.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/remove_outliers.h>
#include <CGAL/wlop_simplify_and_regularize_point_set.h>

#include "timing.hpp"

namespace bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using PointNormal = std::pair<Point, Kernel::Vector_3>;
using One = CGAL::Sequential_tag;

std::vector<Point> convert(const velum::Cloud& cloud) {
  std::vector<Point> out;
  const auto p = cloud.positions();
  for (velum::Index i = 0; i < p.cols(); ++i) out.emplace_back(p(0, i), p(1, i), p(2, i));
  return out;
}

auto maps() {
  return CGAL::parameters::point_map(CGAL::First_of_pair_property_map<PointNormal>())
      .normal_map(CGAL::Second_of_pair_property_map<PointNormal>());
}

std::function<void()> normals(const Input& input) {
  std::vector<PointNormal> pairs;
  for (const Point& p : convert(input.cloud)) pairs.emplace_back(p, Kernel::Vector_3());
  return [pairs]() mutable { CGAL::pca_estimate_normals<One>(pairs, 50, maps()); };
}

std::function<void()> statistical(const Input& input) {
  return [points = convert(input.cloud)]() mutable {
    CGAL::remove_outliers<One>(points, 50, CGAL::parameters::threshold_percent(5.0));
  };
}

std::function<void()> jet_smoothing(const Input& input) {
  return [points = convert(input.cloud)]() mutable { CGAL::jet_smooth_point_set<One>(points, 50); };
}

std::function<void()> bilateral(const Input& input) {
  std::vector<PointNormal> pairs;
  const auto n = input.normals.normals();
  for (const Point& p : convert(input.normals)) {
    const auto i = static_cast<velum::Index>(pairs.size());
    pairs.emplace_back(p, Kernel::Vector_3(n(0, i), n(1, i), n(2, i)));
  }
  return [pairs]() mutable {
    CGAL::bilateral_smooth_point_set<One>(pairs, 50, maps().sharpness_angle(25.0));
  };
}

std::function<void()> wlop(const Input& input) {
  return [points = convert(input.cloud), radius = input.radius] {
    std::vector<Point> out;
    auto given = points;
    CGAL::wlop_simplify_and_regularize_point_set<One>(
        given, std::back_inserter(out),
        CGAL::parameters::select_percentage(20.0).neighbor_radius(radius).number_of_iterations(5));
  };
}

}  // namespace

Contenders cgal_points() {
  return {{"normals, k = 50", "CGAL", normals},
          {"statistical outliers, k = 50", "CGAL", statistical},
          {"MLS, order 2", "CGAL jet", jet_smoothing},
          {"CGAL's jets wrapped, k = 50", "CGAL", jet_smoothing},
          {"CGAL's bilateral wrapped, k = 50", "CGAL", bilateral},
          {"CGAL's WLOP wrapped, 5 rounds", "CGAL", wlop}};
}

}  // namespace bench
