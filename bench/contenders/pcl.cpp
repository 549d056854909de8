// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <omp.h>
#include <pcl/common/transforms.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/filters/crop_box.h>
#include <pcl/filters/radius_outlier_removal.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/transformation_estimation_svd.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/region_growing.h>
#include <pcl/surface/gp3.h>
#include <pcl/surface/mls.h>

#include <numeric>

#include "timing.hpp"

namespace bench {
namespace {

using Plain = pcl::PointCloud<pcl::PointXYZ>;
using Oriented = pcl::PointCloud<pcl::PointNormal>;
using Normals = pcl::PointCloud<pcl::Normal>;

Plain::Ptr plain(const velum::Cloud& cloud) {
  auto out = pcl::make_shared<Plain>();
  const auto p = cloud.positions();
  for (velum::Index i = 0; i < p.cols(); ++i) out->emplace_back(p(0, i), p(1, i), p(2, i));
  return out;
}

Oriented::Ptr oriented(const velum::Cloud& cloud) {
  auto out = pcl::make_shared<Oriented>();
  const auto p = cloud.positions();
  const auto n = cloud.normals();
  for (velum::Index i = 0; i < p.cols(); ++i)
    out->emplace_back(p(0, i), p(1, i), p(2, i), n(0, i), n(1, i), n(2, i));
  return out;
}

Normals::Ptr normals_of(const velum::Cloud& cloud) {
  auto out = pcl::make_shared<Normals>();
  const auto n = cloud.normals();
  const auto c = cloud.curvature();
  for (velum::Index i = 0; i < n.cols(); ++i) out->emplace_back(n(0, i), n(1, i), n(2, i), c(i));
  return out;
}

std::function<void()> normals(const Input& input) {
  return [cloud = plain(input.cloud)] {
    pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation(omp_get_num_procs());
    estimation.setInputCloud(cloud);
    estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
    estimation.setKSearch(50);
    Normals out;
    estimation.compute(out);
  };
}

std::function<void()> region_growing(const Input& input) {
  return [cloud = plain(input.normals), found = normals_of(input.normals)] {
    pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal> growing;
    growing.setInputCloud(cloud);
    growing.setInputNormals(found);
    growing.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
    growing.setNumberOfNeighbours(50);
    growing.setSmoothnessThreshold(static_cast<float>(7.0 / 180.0 * M_PI));
    growing.setCurvatureThreshold(0.05F);
    std::vector<pcl::PointIndices> clusters;
    growing.extract(clusters);
  };
}

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

std::function<void()> mls(const Input& input) {
  return [cloud = plain(input.cloud), radius = input.radius] {
    pcl::MovingLeastSquares<pcl::PointXYZ, pcl::PointNormal> smoothing;
    smoothing.setInputCloud(cloud);
    smoothing.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
    smoothing.setSearchRadius(radius);
    smoothing.setPolynomialOrder(2);
    smoothing.setComputeNormals(true);
    smoothing.setNumberOfThreads(static_cast<unsigned>(omp_get_num_procs()));
    Oriented out;
    smoothing.process(out);
  };
}

std::function<void()> point_to_point(const Input& input) {
  return [source = plain(input.moved), target = plain(input.cloud)] {
    pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
    icp.setInputSource(source);
    icp.setInputTarget(target);
    icp.setMaximumIterations(25);
    icp.setMaxCorrespondenceDistance(0.2);
    icp.setTransformationEpsilon(0.0);
    icp.setEuclideanFitnessEpsilon(-1e9);
    Plain out;
    icp.align(out);
  };
}

std::function<void()> point_to_plane(const Input& input) {
  return [source = oriented(input.moved), target = oriented(input.normals)] {
    pcl::IterativeClosestPointWithNormals<pcl::PointNormal, pcl::PointNormal> icp;
    icp.setInputSource(source);
    icp.setInputTarget(target);
    icp.setMaximumIterations(25);
    icp.setMaxCorrespondenceDistance(0.2);
    icp.setTransformationEpsilon(0.0);
    icp.setEuclideanFitnessEpsilon(-1e9);
    Oriented out;
    icp.align(out);
  };
}

std::function<void()> greedy_projection(const Input& input) {
  return [cloud = oriented(input.smooth), radius = input.radius] {
    pcl::GreedyProjectionTriangulation<pcl::PointNormal> meshing;
    meshing.setInputCloud(cloud);
    meshing.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
    meshing.setSearchRadius(2.0 * radius);
    meshing.setMu(2.5);
    meshing.setMaximumNearestNeighbors(100);
    pcl::PolygonMesh out;
    meshing.reconstruct(out);
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

std::function<void()> svd(const Input& input) {
  return [a = plain(input.cloud), b = plain(input.moved)] {
    pcl::Indices first(1000);
    std::iota(first.begin(), first.end(), 0);
    Eigen::Matrix4f motion;
    pcl::registration::TransformationEstimationSVD<pcl::PointXYZ, pcl::PointXYZ>()
        .estimateRigidTransformation(*a, first, *b, first, motion);
  };
}

std::function<void()> write_pcd(const Input& input) {
  return [cloud = plain(input.cloud), file = input.folder + "/pcl.pcd"] {
    pcl::io::savePCDFileBinary(file, *cloud);
  };
}

std::function<void()> write_ply(const Input& input) {
  return [cloud = plain(input.cloud), file = input.folder + "/pcl.ply"] {
    pcl::io::savePLYFileBinary(file, *cloud);
  };
}

template <int (*Load)(const std::string&, Plain&)>
std::function<void()> reader(const std::string& file) {
  return [file] {
    Plain out;
    if (Load(file, out) < 0) throw std::runtime_error("PCL cannot read " + file);
  };
}

}  // namespace

std::vector<Contender> pcl_contenders() {
  using pcl::io::loadPCDFile;
  using pcl::io::loadPLYFile;
  return {
      {"normals, k = 50", "PCL", normals},
      {"region growing, k = 50", "PCL", region_growing},
      {"statistical outliers, k = 50", "PCL", statistical},
      {"radius outliers", "PCL", radius_outliers},
      {"MLS, order 2", "PCL", mls},
      {"ICP point to point, 25 iterations", "PCL", point_to_point},
      {"ICP point to plane, 25 iterations", "PCL", point_to_plane},
      {"meshing", "PCL greedy projection", greedy_projection},
      {"region of interest", "PCL", box},
      {"move a cloud", "PCL", moved},
      {"merge two clouds", "PCL", merged},
      {"SVD of 1,000 pairs", "PCL", svd},
      {"write PCD, binary", "PCL", write_pcd},
      {"write PLY, binary", "PCL", write_ply},
      {"read PCD, binary", "PCL",
       [](const Input& i) { return reader<loadPCDFile>(i.folder + "/cloud.pcd"); }},
      {"read PCD, ascii", "PCL",
       [](const Input& i) { return reader<loadPCDFile>(i.folder + "/cloud_ascii.pcd"); }},
      {"read PLY, binary", "PCL",
       [](const Input& i) { return reader<loadPLYFile>(i.folder + "/cloud.ply"); }},
  };
}

}  // namespace bench
