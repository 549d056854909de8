// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Shape_detection/Efficient_RANSAC.h>
#include <CGAL/Simple_cartesian.h>

#include <array>
#include <velum/testing.hpp>

#include "timing.hpp"

namespace bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Simple = CGAL::Simple_cartesian<double>;

template <class K>
std::vector<typename K::Point_3> convert(const velum::ConstPoints& p) {
  std::vector<typename K::Point_3> out;
  for (velum::Index i = 0; i < p.cols(); ++i) out.emplace_back(p(0, i), p(1, i), p(2, i));
  return out;
}

std::function<void()> advancing_front(const Input& input) {
  return [points = convert<Kernel>(input.smooth.positions())] {
    std::vector<std::array<std::size_t, 3>> facets;
    CGAL::advancing_front_surface_reconstruction(points.begin(), points.end(),
                                                 std::back_inserter(facets));
  };
}

std::function<void()> tetrahedra(const Input& input) {
  return [points = convert<Kernel>(input.smooth.positions())] {
    const CGAL::Delaunay_triangulation_3<Kernel> made(points.begin(), points.end());
  };
}

std::function<void()> efficient_ransac(const Input& input) {
  using Oriented = std::pair<Simple::Point_3, Simple::Vector_3>;
  using Traits =
      CGAL::Shape_detection::Efficient_RANSAC_traits<Simple, std::vector<Oriented>,
                                                     CGAL::First_of_pair_property_map<Oriented>,
                                                     CGAL::Second_of_pair_property_map<Oriented>>;
  std::vector<Oriented> points;
  const auto n = input.scene.normals();
  for (const auto& p : convert<Simple>(input.scene.positions())) {
    const auto i = static_cast<velum::Index>(points.size());
    points.emplace_back(p, Simple::Vector_3(n(0, i), n(1, i), n(2, i)));
  }
  return [points, gap = 2.0 * input.gap]() mutable {
    CGAL::Shape_detection::Efficient_RANSAC<Traits> detector;
    detector.set_input(points);
    detector.add_shape_factory<CGAL::Shape_detection::Plane<Traits>>();
    decltype(detector)::Parameters parameters;
    parameters.probability = 0.01;
    parameters.min_points = std::max<std::size_t>(50, points.size() / 100);
    parameters.epsilon = 0.02;
    parameters.cluster_epsilon = gap;
    parameters.normal_threshold = std::cos(20.0 / 180.0 * M_PI);
    detector.detect(parameters);
  };
}

/// Distances alone, without normals and curvature; the tree is made anew, as ours is.
std::function<void()> nearest_on_mesh(const Input& input) {
  using Primitive =
      CGAL::AABB_triangle_primitive<Simple, std::vector<Simple::Triangle_3>::const_iterator>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Simple, Primitive>>;
  const auto mesh = velum::test::Stage("meshing.delaunay_projected").run(input.smooth).mesh();
  const auto corners = convert<Simple>(mesh.positions());
  std::vector<Simple::Triangle_3> triangles;
  for (velum::Index i = 0; i < mesh.size(); ++i) {
    const auto t = mesh.triangles().col(i).cast<std::size_t>().eval();
    triangles.emplace_back(corners[t[0]], corners[t[1]], corners[t[2]]);
  }
  return [triangles, points = convert<Simple>(input.normals.positions())] {
    Tree tree(triangles.begin(), triangles.end());
    tree.accelerate_distance_queries();
    std::vector<double> distances;
    for (const auto& point : points) distances.push_back(std::sqrt(tree.squared_distance(point)));
  };
}

}  // namespace

Contenders cgal_surfaces() {
  return {{"meshing", "CGAL advancing front", advancing_front},
          {"CGAL's advancing front wrapped", "CGAL", advancing_front},
          {"Delaunay tetrahedra, short faces", "CGAL, tetrahedra only", tetrahedra},
          {"RANSAC, six planes of a room", "CGAL, all planes", efficient_ransac},
          {"CGAL's RANSAC wrapped, planes", "CGAL", efficient_ransac},
          {"cloud to mesh", "CGAL, distances only", nearest_on_mesh}};
}

}  // namespace bench
