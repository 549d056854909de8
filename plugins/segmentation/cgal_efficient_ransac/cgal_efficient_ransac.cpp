// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT

#include <CGAL/Random.h>
#include <CGAL/Shape_detection/Efficient_RANSAC.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>
#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <tuple>
#include <velum/stage.hpp>

#include "shapes/parameters.hpp"
#include "shapes/table.hpp"

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
// Position, normal, and the number that the point has outside: CGAL sorts its points as it works.
using Oriented = std::tuple<Kernel::Point_3, Kernel::Vector_3, velum::Index>;
using Traits =
    CGAL::Shape_detection::Efficient_RANSAC_traits<Kernel, std::vector<Oriented>,
                                                   CGAL::Nth_of_tuple_property_map<0, Oriented>,
                                                   CGAL::Nth_of_tuple_property_map<1, Oriented>>;
using Detector = CGAL::Shape_detection::Efficient_RANSAC<Traits>;
using velum::shapes::Kind;
using velum::shapes::Shape;

enum class Model { any, plane, sphere, cylinder, cone };

template <class V>
Eigen::Vector3d eigen(const V& v) {
  return {v.x(), v.y(), v.z()};
}

Shape shape_of(const Detector::Shape& found) {
  if (const auto* plane = dynamic_cast<const CGAL::Shape_detection::Plane<Traits>*>(&found)) {
    const Eigen::Vector3d normal = eigen(plane->plane_normal()).normalized();
    const Kernel::Plane_3 p(*plane);
    const double offset = p.d() / eigen(p.orthogonal_vector()).norm();
    const double sign = eigen(p.orthogonal_vector()).dot(normal) < 0.0 ? -1.0 : 1.0;
    return {.kind = Kind::plane, .point = -sign * offset * normal, .axis = normal};
  }
  if (const auto* ball = dynamic_cast<const CGAL::Shape_detection::Sphere<Traits>*>(&found))
    return {.kind = Kind::sphere, .point = eigen(ball->center()), .radius = ball->radius()};
  if (const auto* tube = dynamic_cast<const CGAL::Shape_detection::Cylinder<Traits>*>(&found)) {
    const auto axis = tube->axis();
    return {.kind = Kind::cylinder,
            .point = eigen(axis.point(0)),
            .axis = eigen(axis.to_vector()).normalized(),
            .radius = tube->radius()};
  }
  const auto& cone = dynamic_cast<const CGAL::Shape_detection::Cone<Traits>&>(found);
  return {.kind = Kind::cone,
          .point = eigen(cone.apex()),
          .axis = eigen(cone.axis()).normalized(),
          .angle = cone.angle()};
}

struct CgalEfficientRansac {
  Model model = Model::any;
  std::optional<velum::Length> epsilon;
  velum::Angle angle = {20.0 * std::numbers::pi / 180.0};
  std::optional<int> min_size;
  velum::Length gap = velum::spacings(20.0);
  double overlook = 0.01;

  static auto about() {
    velum::About<CgalEfficientRansac> about(
        "Planes, spheres, cylinders and cones by CGAL's efficient RANSAC.");
    about.in("cloud")
        .needs("cloud", "normals")
        .out("clusters", "numbered from the largest to the smallest")
        .choice(&CgalEfficientRansac::model, "model", "which shapes are sought",
                {{"any", Model::any, "all four"},
                 {"plane", Model::plane, "planes only"},
                 {"sphere", Model::sphere, "spheres only"},
                 {"cylinder", Model::cylinder, "cylinders only"},
                 {"cone", Model::cone, "cones only"}});
    return velum::shapes::add_tolerances(about)
        .param(&CgalEfficientRansac::gap, "gap",
               "cells of the map in which a shape's points must hang together", velum::above(0.0))
        .param(&CgalEfficientRansac::overlook, "overlook", "chance of missing the largest shape",
               velum::between(1e-9, 0.5))
        .advanced()
        .seeded()
        .isolated()
        .licence("GPL-3.0-or-later")
        .reference("CGAL, Point Set Shape Detection: Efficient_RANSAC")
        .reference(
            "R. Schnabel, R. Wahl, R. Klein, Efficient RANSAC for Point-Cloud Shape Detection "
            "(2007)");
  }

  velum::Clusters operator()(const velum::Cloud& cloud, velum::Context& context) const {
    Detector::Parameters parameters;
    parameters.probability = overlook;
    const int least = velum::shapes::least_points(min_size, cloud);
    parameters.min_points = static_cast<std::size_t>(least);
    parameters.epsilon = velum::shapes::tolerance(epsilon, cloud, context);
    parameters.cluster_epsilon = std::max(gap.value, parameters.epsilon);
    parameters.normal_threshold = std::cos(angle);
    velum::shapes::Labelled found{Eigen::VectorXi::Constant(cloud.size(), -1), {}, {}};
    // CGAL's octree never ends on points that are all in one place.
    if (cloud.size() >= least && cloud.diagonal() > 0.0) detect(cloud, parameters, found, context);
    velum::shapes::keep_sizes(found, 1, cloud.size());
    velum::Clusters clusters = velum::shapes::clusters_of(cloud, std::move(found), context);
    velum::shapes::measure(clusters, context);
    velum::shapes::warn_of_nothing(clusters, "shape", least, parameters.epsilon, context);
    return clusters;
  }

 private:
  void add_factories(Detector& detector) const {
    const auto wanted = [&](Model one) { return model == Model::any || model == one; };
    if (wanted(Model::plane)) detector.add_shape_factory<CGAL::Shape_detection::Plane<Traits>>();
    if (wanted(Model::sphere)) detector.add_shape_factory<CGAL::Shape_detection::Sphere<Traits>>();
    if (wanted(Model::cylinder))
      detector.add_shape_factory<CGAL::Shape_detection::Cylinder<Traits>>();
    if (wanted(Model::cone)) detector.add_shape_factory<CGAL::Shape_detection::Cone<Traits>>();
  }

  void detect(const velum::Cloud& cloud, const Detector::Parameters& parameters,
              velum::shapes::Labelled& found, velum::Context& context) const {
    std::vector<Oriented> points;
    points.reserve(static_cast<std::size_t>(cloud.size()));
    for (velum::Index i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d p = cloud.positions().col(i).cast<double>();
      const Eigen::Vector3d n = cloud.normals().col(i).cast<double>();
      points.emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()),
                          Kernel::Vector_3(n.x(), n.y(), n.z()), i);
    }
    // The default generator is this thread's own; CGAL seeds it by the clock.
    CGAL::get_default_random() = CGAL::Random(static_cast<unsigned>(context.random().next()));
    Detector detector;
    detector.set_input(points);
    add_factories(detector);
    bool done = false;
    try {
      done = detector.detect(parameters, [&](double) { return !context.cancelled(); });
    } catch (const std::exception& error) {
      throw velum::Error(velum::Fault::stage,
                         fmt::format("CGAL's efficient RANSAC failed: {}", error.what()));
    }
    context.check();
    if (!done) return;
    for (const auto& shape : detector.shapes()) {
      const auto number = static_cast<int>(found.shapes.size());
      for (const std::size_t point : shape->indices_of_assigned_points())
        found.labels[std::get<2>(points[point])] = number;
      found.shapes.emplace_back(shape_of(*shape));
      found.scores.push_back(static_cast<double>(shape->indices_of_assigned_points().size()));
    }
  }
};

}  // namespace
VELUM_STAGE(CgalEfficientRansac)
