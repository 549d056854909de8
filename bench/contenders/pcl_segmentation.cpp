// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <pcl/ModelCoefficients.h>
#include <pcl/segmentation/extract_clusters.h>
#include <pcl/segmentation/region_growing.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <numeric>

#include "pcl_clouds.hpp"

namespace bench {
namespace {

std::function<void()> region_growing(const Input& input) {
  return [cloud = plain(input.normals), found = normals_of(input.normals)] {
    pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal> growing;
    growing.setInputCloud(cloud);
    growing.setInputNormals(found);
    growing.setSearchMethod(tree<pcl::PointXYZ>());
    growing.setNumberOfNeighbours(50);
    growing.setSmoothnessThreshold(static_cast<float>(7.0 / 180.0 * M_PI));
    growing.setCurvatureThreshold(0.05F);
    std::vector<pcl::PointIndices> clusters;
    growing.extract(clusters);
  };
}

std::function<void()> euclidean(const Input& input) {
  return [cloud = plain(input.scene), gap = input.gap] {
    pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
    extraction.setInputCloud(cloud);
    extraction.setSearchMethod(tree<pcl::PointXYZ>());
    extraction.setClusterTolerance(gap);
    extraction.setMinClusterSize(10);
    std::vector<pcl::PointIndices> clusters;
    extraction.extract(clusters);
  };
}

/// One shape after another, each without the points of those before.
std::function<void()> six_planes(const Input& input) {
  return [cloud = plain(input.scene), found = normals_of(input.scene)] {
    auto left = pcl::make_shared<pcl::Indices>(cloud->size());
    std::iota(left->begin(), left->end(), 0);
    for (int shape = 0; shape < 6; ++shape) {
      pcl::SACSegmentationFromNormals<pcl::PointXYZ, pcl::Normal> segmentation;
      segmentation.setModelType(pcl::SACMODEL_NORMAL_PLANE);
      segmentation.setMethodType(pcl::SAC_RANSAC);
      segmentation.setDistanceThreshold(0.02);
      segmentation.setNormalDistanceWeight(0.1);
      segmentation.setMaxIterations(1000);
      segmentation.setInputCloud(cloud);
      segmentation.setInputNormals(found);
      segmentation.setIndices(left);
      pcl::PointIndices inliers;
      pcl::ModelCoefficients coefficients;
      segmentation.segment(inliers, coefficients);
      std::vector<bool> taken(cloud->size());
      for (const int point : inliers.indices) taken[static_cast<std::size_t>(point)] = true;
      auto rest = pcl::make_shared<pcl::Indices>();
      for (const int point : *left)
        if (!taken[static_cast<std::size_t>(point)]) rest->push_back(point);
      left = rest;
    }
  };
}

}  // namespace

Contenders pcl_segmentation() {
  return {{"region growing, k = 50", "PCL", region_growing},
          {"PCL's region growing wrapped, k = 50", "PCL", region_growing},
          {"Euclidean clusters of a room", "PCL", euclidean},
          {"RANSAC, six planes of a room", "PCL", six_planes},
          {"PCL's RANSAC wrapped, six planes", "PCL", six_planes},
          {"Hough, six planes of a room", "PCL RANSAC", six_planes}};
}

}  // namespace bench
