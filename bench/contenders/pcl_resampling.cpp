// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <pcl/filters/voxel_grid.h>
#include <pcl/surface/mls.h>

#include "pcl_clouds.hpp"

namespace bench {
namespace {

using Smoothing = pcl::MovingLeastSquares<pcl::PointXYZ, pcl::PointNormal>;

void set_up(Smoothing& smoothing, const Plain::Ptr& cloud, double radius) {
  smoothing.setInputCloud(cloud);
  smoothing.setSearchMethod(tree<pcl::PointXYZ>());
  smoothing.setSearchRadius(radius);
  smoothing.setPolynomialOrder(2);
  smoothing.setComputeNormals(true);
  smoothing.setNumberOfThreads(static_cast<unsigned>(omp_get_num_procs()));
}

std::function<void()> mls(const Input& input) {
  return [cloud = plain(input.cloud), radius = input.radius] {
    Smoothing smoothing;
    set_up(smoothing, cloud, radius);
    Oriented out;
    smoothing.process(out);
  };
}

std::function<void()> upsample(const Input& input) {
  return [cloud = plain(input.smooth), radius = input.radius] {
    Smoothing smoothing;
    set_up(smoothing, cloud, radius);
    smoothing.setUpsamplingMethod(Smoothing::SAMPLE_LOCAL_PLANE);
    smoothing.setUpsamplingRadius(0.25 * radius);
    smoothing.setUpsamplingStepSize(0.125 * radius);
    Oriented out;
    smoothing.process(out);
  };
}

std::function<void()> voxel_grid(const Input& input) {
  return [cloud = plain(input.cloud), edge = static_cast<float>(input.radius)] {
    pcl::VoxelGrid<pcl::PointXYZ> grid;
    grid.setInputCloud(cloud);
    grid.setLeafSize(edge, edge, edge);
    Plain out;
    grid.filter(out);
  };
}

}  // namespace

Contenders pcl_resampling() {
  return {{"voxel grid", "PCL", voxel_grid},
          {"MLS, order 2", "PCL", mls},
          {"PCL's MLS wrapped, order 2", "PCL", mls},
          {"upsample to half the spacing", "PCL MLS, local planes", upsample}};
}

}  // namespace bench
