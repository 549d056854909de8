// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/ndt.h>

#include "pcl_clouds.hpp"

namespace bench {
namespace {

/// Makes all iterations and no fewer.
template <class Method, class Cloud>
void align(Method& method, const Cloud& source, const Cloud& target, int iterations) {
  method.setInputSource(source);
  method.setInputTarget(target);
  method.setMaximumIterations(iterations);
  method.setMaxCorrespondenceDistance(0.2);
  method.setTransformationEpsilon(0.0);
  method.setEuclideanFitnessEpsilon(-1e9);
  typename Cloud::element_type out;
  method.align(out);
}

Prepare point_to_point(int iterations) {
  return [=](const Input& input) {
    return [=, source = plain(input.moved), target = plain(input.cloud)] {
      pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
      align(icp, source, target, iterations);
    };
  };
}

Prepare with_normals(bool symmetric) {
  return [=](const Input& input) {
    return [=, source = oriented(input.moved), target = oriented(input.normals)] {
      pcl::IterativeClosestPointWithNormals<pcl::PointNormal, pcl::PointNormal> icp;
      icp.setUseSymmetricObjective(symmetric);
      align(icp, source, target, 25);
    };
  };
}

std::function<void()> generalised(const Input& input) {
  return [source = plain(input.moved), target = plain(input.cloud)] {
    pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> gicp;
    gicp.setInputSource(source);
    gicp.setInputTarget(target);
    gicp.setMaximumIterations(5);
    gicp.setMaxCorrespondenceDistance(0.2);
    Plain out;
    gicp.align(out);
  };
}

std::function<void()> distributions(const Input& input) {
  return [source = plain(input.moved), target = plain(input.cloud)] {
    pcl::NormalDistributionsTransform<pcl::PointXYZ, pcl::PointXYZ> ndt;
    ndt.setResolution(0.4F);
    ndt.setMinPointPerVoxel(6);
    ndt.setInputSource(source);
    ndt.setInputTarget(target);
    ndt.setStepSize(0.05);
    ndt.setMaximumIterations(10);
    ndt.setTransformationEpsilon(1e-12);
    Plain out;
    ndt.align(out);
  };
}

}  // namespace

Contenders pcl_icp() {
  return {{"ICP point to point, 25 iterations", "PCL", point_to_point(25)},
          {"ICP point to plane, 25 iterations", "PCL", with_normals(false)},
          {"ICP symmetric, 25 iterations", "PCL", with_normals(true)},
          {"PCL's ICP wrapped, 10 iterations", "PCL", point_to_point(10)},
          {"PCL's GICP wrapped, 5 iterations", "PCL", generalised},
          {"PCL's NDT wrapped, 10 iterations", "PCL", distributions}};
}

}  // namespace bench
