// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <pcl/kdtree/kdtree_flann.h>

#include <cmath>

#include "pcl_clouds.hpp"

namespace bench {
namespace {

/// Distances alone, without normals and curvature.
std::function<void()> nearest(const Input& input) {
  return [source = plain(input.moved), target = plain(input.normals)] {
    pcl::KdTreeFLANN<pcl::PointXYZ> index;
    index.setInputCloud(target);
    pcl::Indices found(1);
    std::vector<float> squared(1);
    std::vector<float> distances;
    for (const auto& point : *source) {
      index.nearestKSearch(point, 1, found, squared);
      distances.push_back(std::sqrt(squared[0]));
    }
  };
}

}  // namespace

Contenders pcl_analysis() {
  return {{"cloud to cloud", "PCL, distances only", nearest}};
}

}  // namespace bench
