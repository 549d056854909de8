// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT

#include <pcl/ModelCoefficients.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <velum/stage.hpp>

#include "pcl/clouds.hpp"
#include "shapes/parameters.hpp"
#include "shapes/table.hpp"

namespace {

using velum::shapes::Kind;
using velum::shapes::Shape;
using Segmentation = pcl::SACSegmentationFromNormals<pcl::PointXYZ, pcl::Normal>;

// PCL's coefficients: plane normal and offset; centre and radius; point, axis and radius; apex,
// axis and half the opening angle.
std::optional<Shape> shape_of(Kind kind, const std::vector<float>& values) {
  constexpr std::array<std::size_t, 4> kCounts = {4, 4, 7, 7};
  if (values.size() != kCounts.at(static_cast<std::size_t>(kind))) return std::nullopt;
  std::vector<double> c(values.begin(), values.end());
  Shape shape{.kind = kind};
  const Eigen::Vector3d first(c[0], c[1], c[2]);
  if (kind == Kind::plane) {
    shape.axis = first.normalized();
    shape.point = -c[3] / first.norm() * shape.axis;
  } else if (kind == Kind::sphere) {
    shape.point = first;
    shape.radius = c[3];
  } else {
    shape.point = first;
    shape.axis = Eigen::Vector3d(c[3], c[4], c[5]).normalized();
    (kind == Kind::cone ? shape.angle : shape.radius) = c[6];
  }
  if (!shape.point.allFinite() || !shape.axis.allFinite()) return std::nullopt;
  return shape;
}

int model_of(Kind kind) {
  constexpr std::array<int, 4> kModels = {pcl::SACMODEL_NORMAL_PLANE, pcl::SACMODEL_NORMAL_SPHERE,
                                          pcl::SACMODEL_CYLINDER, pcl::SACMODEL_CONE};
  return kModels.at(static_cast<std::size_t>(kind));
}

struct PclRansac {
  Kind model = Kind::plane;
  std::optional<velum::Length> epsilon;
  double normal_weight = 0.1;
  int iterations = 1000;
  std::optional<int> min_size;
  std::optional<int> shapes;
  velum::Length max_radius = velum::diagonals(0.5);

  static auto about() {
    return velum::About<PclRansac>("Shapes of one kind by PCL's RANSAC, one after another.")
        .in("cloud")
        .needs("cloud", "normals")
        .out("clusters", "numbered from the largest to the smallest")
        .choice(&PclRansac::model, "model", "which shapes are sought",
                {{"plane", Kind::plane, "planes"},
                 {"sphere", Kind::sphere, "spheres"},
                 {"cylinder", Kind::cylinder, "cylinders"},
                 {"cone", Kind::cone, "cones"}})
        .param(&PclRansac::epsilon, "epsilon",
               "greatest distance of a point from its shape, the weighted angle counted in; unset: "
               "six times the cloud's noise, at least a tenth of its spacing",
               velum::above(0.0))
        .param(&PclRansac::normal_weight, "normal_weight",
               "weight of the angle between normals [rad] against the distance",
               velum::between(0.0, 1.0))
        .param(&PclRansac::iterations, "iterations", "most samples for one shape",
               velum::between(1, 1000000))
        .param(&PclRansac::min_size, "min_size",
               "fewer points make no shape; unset: 1 % of the cloud, at least 50",
               velum::at_least(3))
        .param(&PclRansac::shapes, "shapes", "most shapes to be found; unset: all",
               velum::at_least(1))
        .param(&PclRansac::max_radius, "max_radius", "greatest radius of a sphere or cylinder",
               velum::above(0.0))
        .deterministic()
        .isolated()
        .reference("Point Cloud Library, pcl::SACSegmentationFromNormals")
        .reference("thesis 3.3.2: Algorithm 3.4, tables 3.24 and 3.25");
  }

  velum::Clusters operator()(const velum::Cloud& cloud, velum::Context& context) const {
    const int least = velum::shapes::least_points(min_size, cloud);
    const double near = velum::shapes::tolerance(epsilon, cloud, context);
    velum::shapes::Labelled found{Eigen::VectorXi::Constant(cloud.size(), -1), {}, {}};
    auto left = std::make_shared<std::vector<int>>(static_cast<std::size_t>(cloud.size()));
    std::iota(left->begin(), left->end(), 0);
    const auto positions = velum::with_pcl::positions(cloud);
    const auto normals = velum::with_pcl::normals(cloud);
    while (static_cast<int>(left->size()) >= std::max(least, 3) &&
           static_cast<int>(found.shapes.size()) < shapes.value_or(1000)) {
      context.check();
      pcl::PointIndices inliers;
      pcl::ModelCoefficients coefficients;
      velum::with_pcl::quietly("PCL's RANSAC", [&] {
        Segmentation segmentation;
        segmentation.setModelType(model_of(model));
        segmentation.setMethodType(pcl::SAC_RANSAC);
        segmentation.setDistanceThreshold(near);
        segmentation.setNormalDistanceWeight(normal_weight);
        segmentation.setMaxIterations(iterations);
        segmentation.setOptimizeCoefficients(true);
        segmentation.setRadiusLimits(0.0, max_radius > 0.0 ? max_radius.value : 1.0);
        segmentation.setMinMaxOpeningAngle(0.05, 1.4);
        segmentation.setInputCloud(positions);
        segmentation.setInputNormals(normals);
        segmentation.setIndices(left);
        segmentation.segment(inliers, coefficients);
      });
      const auto shape = shape_of(model, coefficients.values);
      if (static_cast<int>(inliers.indices.size()) < least || !shape) break;
      const auto number = static_cast<int>(found.shapes.size());
      for (const int point : inliers.indices) found.labels[point] = number;
      found.shapes.emplace_back(shape);
      found.scores.push_back(static_cast<double>(inliers.indices.size()));
      // PCL keeps the list that it was given.
      auto rest = std::make_shared<std::vector<int>>();
      std::copy_if(left->begin(), left->end(), std::back_inserter(*rest),
                   [&](int point) { return found.labels[point] < 0; });
      left = std::move(rest);
    }
    velum::shapes::keep_sizes(found, 1, cloud.size());
    velum::Clusters clusters = velum::shapes::clusters_of(cloud, std::move(found), context);
    velum::shapes::measure(clusters, context);
    velum::shapes::warn_of_nothing(clusters, velum::shapes::name_of(model), least, near, context);
    return clusters;
  }
};

}  // namespace
VELUM_STAGE(PclRansac)
