// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/search/kdtree.h>

#include <velum/stage.hpp>

#include "geometry/viewpoint.hpp"
#include "pcl/clouds.hpp"

namespace {

struct PclNormals {
  std::optional<int> neighbours;
  std::optional<velum::Length> radius;

  static auto about() {
    return velum::About<PclNormals>("Normals and curvature as the Point Cloud Library finds them.")
        .in("cloud")
        .out("cloud")
        .adds("cloud", "normals")
        .adds("cloud", "curvature")
        .param(&PclNormals::neighbours, "neighbours",
               "points of a neighbourhood, the point itself among them; 20 where neither this nor "
               "radius is set",
               velum::at_least(3))
        .param(&PclNormals::radius, "radius",
               "radius of a neighbourhood, instead of neighbours: only one of the two",
               velum::above(0.0))
        .reference("PCL 1.13: pcl::NormalEstimationOMP; thesis 3.1.3, 3.1.4")
        .deterministic();
  }

  velum::Cloud operator()(const velum::Cloud& cloud, velum::Context& context) const {
    if (neighbours && radius)
      throw velum::Error(velum::Fault::stage,
                         "both neighbours and radius are given; PCL takes one of them")
          .hint("features.normals takes both");
    pcl::PointCloud<pcl::Normal> found;
    if (!cloud.empty()) estimate(cloud, found, context);
    context.check();
    const velum::geometry::Viewpoints viewpoints(cloud);
    velum::Points normals(3, cloud.size());
    Eigen::VectorXf curvature(cloud.size());
    velum::Index degenerate = 0;
    for (velum::Index i = 0; i < cloud.size(); ++i) {
      const pcl::Normal& one = found[static_cast<std::size_t>(i)];
      const Eigen::Vector3d eye = viewpoints.from(i);
      Eigen::Vector3d normal(one.normal_x, one.normal_y, one.normal_z);
      curvature[i] = one.curvature;
      if (!(std::abs(normal.norm() - 1.0) < 1e-2) || !std::isfinite(one.curvature)) {
        ++degenerate;
        normal = eye.norm() > 0.0 ? eye.normalized() : Eigen::Vector3d::UnitZ();
        curvature[i] = 0.0F;
      }
      normals.col(i) = (normal.dot(eye) < 0.0 ? -normal : normal).normalized().cast<float>();
    }
    context.measure("degenerate", static_cast<double>(degenerate), "", velum::Better::lower);
    if (degenerate > 0)
      context.warn(
          fmt::format("{} of {} points have neighbours that fix no plane; their normals "
                      "point to the sensor and their curvature is 0",
                      degenerate, cloud.size()));
    return cloud.with(velum::column::kNormals, velum::Column(std::move(normals)))
        .with(velum::column::kCurvature, velum::Column(std::move(curvature)));
  }

 private:
  void estimate(const velum::Cloud& cloud, pcl::PointCloud<pcl::Normal>& found,
                velum::Context& context) const {
    const auto input = velum::with_pcl::positions(cloud);
    context.check();
    velum::with_pcl::quietly("PCL's estimation of normals", [&] {
      pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation(
          static_cast<unsigned>(context.threads()));
      estimation.setInputCloud(input);
      estimation.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
      if (radius)
        estimation.setRadiusSearch(*radius);
      else
        estimation.setKSearch(neighbours.value_or(20));
      estimation.compute(found);
    });
    if (static_cast<velum::Index>(found.size()) != cloud.size())
      throw velum::Error(velum::Fault::stage, fmt::format("PCL gave {} normals for {} points",
                                                          found.size(), cloud.size()));
  }
};

}  // namespace
VELUM_STAGE(PclNormals)
