// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/mls.h>

#include <algorithm>
#include <cmath>
#include <velum/stage.hpp>

#include "geometry/viewpoint.hpp"
#include "pcl/clouds.hpp"

namespace {

using velum::Cloud;
using velum::Context;
using velum::Index;

enum class Projection { simple, orthogonal };

// PCL's results by the number of the point that they belong to.
struct Row {
  std::int32_t point;
  std::size_t result;
};

struct PclMls {
  velum::Length radius;
  int order = 2;
  Projection projection = Projection::simple;

  static auto about() {
    return velum::About<PclMls>("Moving least squares of the Point Cloud Library.")
        .in("cloud")
        .out("cloud", "points that PCL gave a result for")
        .adds("cloud", "normals")
        .adds("cloud", "curvature")
        .param(&PclMls::radius, "radius", "radius of the neighbourhood", velum::above(0.0))
        .required()
        .param(&PclMls::order, "order", "order of the local polynomials; below 2 a plane",
               velum::between(0, 6))
        .choice(&PclMls::projection, "projection", "how points come to the polynomial",
                {{"simple", Projection::simple, "along the normal of the local plane"},
                 {"orthogonal", Projection::orthogonal, "square to the polynomial"}})
        .advanced()
        .deterministic()
        .reference("thesis 3.4")
        .reference(
            "M. Alexa et al., Computing and rendering point set surfaces, IEEE TVCG 9 (2003)");
  }

  Cloud operator()(const Cloud& cloud, Context& context) const {
    context.check();
    // PCL refuses nothing: fewer than three points just give no result.
    pcl::PointCloud<pcl::PointNormal> smooth;
    std::vector<Row> rows;
    if (cloud.size() >= 3) rows = run(cloud, smooth, context);
    context.check();
    std::vector<std::int32_t> kept;
    velum::Points positions(3, static_cast<Index>(rows.size()));
    velum::Points normals(3, positions.cols());
    Eigen::VectorXf curvature(positions.cols());
    const velum::geometry::Viewpoints viewpoints(cloud);
    for (const Row& row : rows) {
      const auto slot = static_cast<Index>(kept.size());
      const pcl::PointNormal& p = smooth[row.result];
      const Eigen::Vector3f n = p.getNormalVector3fMap().normalized();
      const bool away = viewpoints.from(row.point).dot(n.cast<double>()) < 0.0;
      positions.col(slot) = p.getVector3fMap();
      normals.col(slot) = away ? Eigen::Vector3f(-n) : n;
      curvature[slot] = std::clamp(std::abs(p.curvature), 0.0F, 1.0F / 3.0F);
      kept.push_back(row.point);
    }
    const Index lost = cloud.size() - positions.cols();
    context.measure("lost", static_cast<double>(lost), "", velum::Better::lower);
    if (lost > 0)
      context.warn("PCL gave no result for " + std::to_string(lost) + " of " +
                   std::to_string(cloud.size()) +
                   " points, which have fewer than three neighbours within the radius or such as "
                   "lie on a line; they are left out");
    return cloud.select(kept)
        .with_positions(std::move(positions))
        .with(velum::column::kNormals, velum::Column(std::move(normals)))
        .with(velum::column::kCurvature, velum::Column(std::move(curvature)));
  }

 private:
  // Its threads give the results in an order of chance; `rows` are ascending by point.
  std::vector<Row> run(const Cloud& cloud, pcl::PointCloud<pcl::PointNormal>& smooth,
                       Context& context) const {
    using Method = pcl::MovingLeastSquares<pcl::PointXYZ, pcl::PointNormal>;
    Method method;
    velum::with_pcl::quietly("PCL's moving least squares", [&] {
      method.setInputCloud(velum::with_pcl::positions(cloud));
      method.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
      method.setSearchRadius(radius);
      method.setPolynomialOrder(order);
      method.setComputeNormals(true);
      method.setProjectionMethod(projection == Projection::orthogonal ? pcl::MLSResult::ORTHOGONAL
                                                                      : pcl::MLSResult::SIMPLE);
      method.setNumberOfThreads(static_cast<unsigned int>(context.threads()));
      method.process(smooth);
    });
    const auto indices = method.getCorrespondingIndices();
    std::vector<Row> rows;
    for (std::size_t i = 0; i < std::min(smooth.size(), indices->indices.size()); ++i) {
      const pcl::PointNormal& p = smooth[i];
      const bool sound = p.getVector3fMap().allFinite() && p.getNormalVector3fMap().allFinite() &&
                         p.getNormalVector3fMap().norm() > 0.5F && std::isfinite(p.curvature);
      if (sound) rows.push_back({indices->indices[i], i});
    }
    std::sort(rows.begin(), rows.end(),
              [](const Row& a, const Row& b) { return a.point < b.point; });
    return rows;
  }
};

}  // namespace
VELUM_STAGE(PclMls)
