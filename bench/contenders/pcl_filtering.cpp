// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <pcl/common/transforms.h>
#include <pcl/filters/crop_box.h>
#include <pcl/filters/radius_outlier_removal.h>
#include <pcl/filters/shadowpoints.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/segmentation/segment_differences.h>

#include "pcl_clouds.hpp"

namespace bench {
namespace {

std::function<void()> statistical(const Input& input) {
  return [cloud = plain(input.cloud)] {
    pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
    filter.setInputCloud(cloud);
    filter.setMeanK(50);
    filter.setStddevMulThresh(2.0);
    Plain out;
    filter.filter(out);
  };
}

std::function<void()> radius_outliers(const Input& input) {
  return [cloud = plain(input.cloud), radius = input.radius] {
    pcl::RadiusOutlierRemoval<pcl::PointXYZ> filter;
    filter.setInputCloud(cloud);
    filter.setRadiusSearch(radius);
    filter.setMinNeighborsInRadius(10);
    Plain out;
    filter.filter(out);
  };
}

/// Takes out what is seen at a grazing angle, by the normals alone.
std::function<void()> shadow_points(const Input& input) {
  return [cloud = plain(input.scene), found = normals_of(input.scene)] {
    pcl::ShadowPoints<pcl::PointXYZ, pcl::Normal> filter;
    filter.setInputCloud(cloud);
    filter.setNormals(found);
    filter.setThreshold(0.1F);
    Plain out;
    filter.filter(out);
  };
}

std::function<void()> differences(const Input& input) {
  return [cloud = plain(input.cloud), other = plain(input.moved), radius = input.radius] {
    pcl::SegmentDifferences<pcl::PointXYZ> difference;
    difference.setInputCloud(cloud);
    difference.setTargetCloud(other);
    difference.setSearchMethod(tree<pcl::PointXYZ>());
    difference.setDistanceThreshold(radius * radius);
    Plain out;
    difference.segment(out);
  };
}

std::function<void()> box(const Input& input) {
  return [cloud = plain(input.cloud)] {
    pcl::CropBox<pcl::PointXYZ> filter;
    filter.setInputCloud(cloud);
    filter.setMin({0.0F, -2.0F, 1.0F, 1.0F});
    filter.setMax({2.0F, 2.0F, 4.0F, 1.0F});
    Plain out;
    filter.filter(out);
  };
}

std::function<void()> moved(const Input& input) {
  const Eigen::Affine3f motion(
      Eigen::AngleAxisf(0.5F, Eigen::Vector3f(1.0F, 2.0F, 3.0F).normalized()));
  return [cloud = oriented(input.normals), motion] {
    Oriented out;
    pcl::transformPointCloudWithNormals(*cloud, out, motion);
  };
}

std::function<void()> merged(const Input& input) {
  return [a = plain(input.cloud), b = plain(input.moved)] { const Plain out = *a + *b; };
}

}  // namespace

Contenders pcl_filtering() {
  return {{"statistical outliers, k = 50", "PCL", statistical},
          {"radius outliers", "PCL", radius_outliers},
          {"mixed pixels of a scan", "PCL shadow points", shadow_points},
          {"overlap of two clouds", "PCL", differences},
          {"region of interest", "PCL", box},
          {"move a cloud", "PCL", moved},
          {"merge two clouds", "PCL", merged}};
}

}  // namespace bench
