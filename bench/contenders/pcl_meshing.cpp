// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <pcl/surface/gp3.h>
#include <pcl/surface/poisson.h>

#include "pcl_clouds.hpp"

namespace bench {
namespace {

std::function<void()> greedy_projection(const Input& input) {
  return [cloud = oriented(input.smooth), radius = input.radius] {
    pcl::GreedyProjectionTriangulation<pcl::PointNormal> meshing;
    meshing.setInputCloud(cloud);
    meshing.setSearchMethod(tree<pcl::PointNormal>());
    meshing.setSearchRadius(2.0 * radius);
    meshing.setMu(2.5);
    meshing.setMaximumNearestNeighbors(100);
    pcl::PolygonMesh out;
    meshing.reconstruct(out);
  };
}

std::function<void()> poisson(const Input& input) {
  return [cloud = oriented(input.smooth)] {
    pcl::Poisson<pcl::PointNormal> meshing;
    meshing.setInputCloud(cloud);
    meshing.setDepth(8);
    meshing.setScale(1.1F);
    meshing.setSamplesPerNode(1.0F);
    meshing.setPointWeight(4.0F);
    pcl::PolygonMesh out;
    meshing.reconstruct(out);
  };
}

}  // namespace

Contenders pcl_meshing() {
  return {{"meshing", "PCL greedy projection", greedy_projection},
          {"PCL's greedy projection wrapped", "PCL", greedy_projection},
          {"PCL's Poisson wrapped, depth 8", "PCL", poisson}};
}

}  // namespace bench
