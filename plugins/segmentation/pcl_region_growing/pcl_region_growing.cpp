// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/region_growing.h>

#include <numbers>
#include <velum/stage.hpp>

#include "geometry/growing_parameters.hpp"
#include "pcl/clouds.hpp"
#include "shapes/table.hpp"

namespace {

using Growing = pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal>;

struct PclRegionGrowing {
  int neighbours = 50;
  velum::Angle smoothness = {7.0 * std::numbers::pi / 180.0};
  double curvature = 0.05;
  int min_size = 100;
  std::optional<int> max_size;

  static auto about() {
    velum::About<PclRegionGrowing> about("Smooth regions by PCL's region growing.");
    about.in("cloud")
        .needs("cloud", "normals")
        .needs("cloud", "curvature")
        .out("clusters", "numbered from the largest to the smallest");
    return velum::geometry::add_growing(about)
        .deterministic()
        .reference("Point Cloud Library, pcl::RegionGrowing")
        .reference("thesis 3.3.3: Algorithm 3.5");
  }

  void check() const {
    if (max_size.value_or(std::numeric_limits<int>::max()) < min_size)
      throw velum::Error(velum::Fault::graph,
                         fmt::format("max_size {} is below min_size {}", *max_size, min_size))
          .at("max_size");
  }

  velum::Clusters operator()(const velum::Cloud& cloud, velum::Context& context) const {
    const int most = max_size.value_or(std::numeric_limits<int>::max());
    context.check();
    std::vector<pcl::PointIndices> regions;
    // PCL asks the tree for more neighbours than there are points without looking.
    if (cloud.size() >= 2) regions = grown(cloud, most);
    context.check();

    velum::shapes::Labelled found{Eigen::VectorXi::Constant(cloud.size(), -1), {}, {}};
    for (const auto& region : regions) {
      const auto number = static_cast<int>(found.shapes.size());
      for (const int point : region.indices) found.labels[point] = number;
      found.shapes.emplace_back();
      found.scores.push_back(static_cast<double>(region.indices.size()));
    }
    velum::shapes::keep_sizes(found, min_size, most);
    velum::Clusters clusters = velum::shapes::clusters_of(cloud, std::move(found), context);
    velum::shapes::measure(clusters, context);
    if (clusters.kinds.empty() && !cloud.empty())
      context.warn(fmt::format("no region has {} points (min_size) or more", min_size));
    return clusters;
  }

 private:
  [[nodiscard]] std::vector<pcl::PointIndices> grown(const velum::Cloud& cloud, int most) const {
    std::vector<pcl::PointIndices> regions;
    velum::with_pcl::quietly("PCL's region growing", [&] {
      Growing growing;
      growing.setMinClusterSize(static_cast<pcl::uindex_t>(min_size));
      growing.setMaxClusterSize(static_cast<pcl::uindex_t>(most));
      growing.setNumberOfNeighbours(
          static_cast<unsigned>(std::min<velum::Index>(neighbours, cloud.size())));
      growing.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
      growing.setSmoothnessThreshold(static_cast<float>(smoothness.radians));
      growing.setCurvatureThreshold(static_cast<float>(curvature));
      growing.setInputCloud(velum::with_pcl::positions(cloud));
      growing.setInputNormals(velum::with_pcl::normals(cloud));
      growing.extract(regions);
    });
    return regions;
  }
};

}  // namespace
VELUM_STAGE(PclRegionGrowing)
