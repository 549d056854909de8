// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <pcl/features/fpfh_omp.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/features/pfh.h>

#include "pcl_clouds.hpp"

namespace bench {
namespace {

std::function<void()> normals(const Input& input) {
  return [cloud = plain(input.cloud)] {
    pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation(omp_get_num_procs());
    estimation.setInputCloud(cloud);
    estimation.setSearchMethod(tree<pcl::PointXYZ>());
    estimation.setKSearch(50);
    Normals out;
    estimation.compute(out);
  };
}

std::function<void()> fpfh(const Input& input) {
  return [cloud = plain(input.normals), found = normals_of(input.normals)] {
    pcl::FPFHEstimationOMP<pcl::PointXYZ, pcl::Normal, pcl::FPFHSignature33> estimation(
        omp_get_num_procs());
    estimation.setInputCloud(cloud);
    estimation.setInputNormals(found);
    estimation.setSearchMethod(tree<pcl::PointXYZ>());
    estimation.setKSearch(50);
    pcl::PointCloud<pcl::FPFHSignature33> out;
    estimation.compute(out);
  };
}

std::function<void()> pfh(const Input& input) {
  return [cloud = plain(input.normals), found = normals_of(input.normals)] {
    pcl::PFHEstimation<pcl::PointXYZ, pcl::Normal, pcl::PFHSignature125> estimation;
    estimation.setInputCloud(cloud);
    estimation.setInputNormals(found);
    estimation.setSearchMethod(tree<pcl::PointXYZ>());
    estimation.setKSearch(20);
    pcl::PointCloud<pcl::PFHSignature125> out;
    estimation.compute(out);
  };
}

}  // namespace

Contenders pcl_features() {
  return {{"normals, k = 50", "PCL", normals},
          {"PCL's normals wrapped, k = 50", "PCL", normals},
          {"FPFH, k = 50", "PCL", fpfh},
          {"PFH, k = 20", "PCL", pfh}};
}

}  // namespace bench
