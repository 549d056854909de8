// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <pcl/features/fpfh_omp.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/features/pfh.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/registration/ia_ransac.h>
#include <pcl/registration/sample_consensus_prerejective.h>
#include <pcl/registration/transformation_estimation_svd.h>

#include <numeric>

#include "pcl_clouds.hpp"

namespace bench {
namespace {

constexpr float kCell = 0.05F;     // about 4,000 cells on the sail [m]
constexpr float kRoomCell = 0.2F;  // as many of the room [m]

/// What both registrations by features look at: thinned points, their normals, their features.
template <class Estimation, class Feature>
struct Described {
  Described(const Plain::Ptr& cloud, float cell) {
    pcl::VoxelGrid<pcl::PointXYZ> grid;
    grid.setInputCloud(cloud);
    grid.setLeafSize(cell, cell, cell);
    grid.filter(*points);
    pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation(omp_get_num_procs());
    estimation.setInputCloud(points);
    estimation.setSearchMethod(tree<pcl::PointXYZ>());
    estimation.setKSearch(20);
    Normals::Ptr normals(new Normals);
    estimation.compute(*normals);
    Estimation describe;
    describe.setInputCloud(points);
    describe.setInputNormals(normals);
    describe.setSearchMethod(tree<pcl::PointXYZ>());
    describe.setRadiusSearch(5.0 * cell);
    describe.compute(*features);
  }
  Plain::Ptr points{new Plain};
  typename pcl::PointCloud<Feature>::Ptr features{new pcl::PointCloud<Feature>};
};

using Fast = pcl::FPFHEstimationOMP<pcl::PointXYZ, pcl::Normal, pcl::FPFHSignature33>;
using Slow = pcl::PFHEstimation<pcl::PointXYZ, pcl::Normal, pcl::PFHSignature125>;

std::function<void()> prerejective(const Input& input) {
  return [from = plain(input.other), to = plain(input.scene)] {
    const Described<Fast, pcl::FPFHSignature33> source(from, kRoomCell);
    const Described<Fast, pcl::FPFHSignature33> target(to, kRoomCell);
    pcl::SampleConsensusPrerejective<pcl::PointXYZ, pcl::PointXYZ, pcl::FPFHSignature33> method;
    method.setInputSource(source.points);
    method.setSourceFeatures(source.features);
    method.setInputTarget(target.points);
    method.setTargetFeatures(target.features);
    method.setMaximumIterations(20000);
    method.setNumberOfSamples(3);
    method.setCorrespondenceRandomness(5);
    method.setSimilarityThreshold(0.9F);
    method.setMaxCorrespondenceDistance(1.5 * kRoomCell);
    method.setInlierFraction(0.25F);
    Plain out;
    method.align(out);
  };
}

std::function<void()> initial_alignment(const Input& input) {
  return [from = plain(input.moved), to = plain(input.cloud)] {
    const Described<Slow, pcl::PFHSignature125> source(from, kCell);
    const Described<Slow, pcl::PFHSignature125> target(to, kCell);
    pcl::SampleConsensusInitialAlignment<pcl::PointXYZ, pcl::PointXYZ, pcl::PFHSignature125> method;
    method.setInputSource(source.points);
    method.setSourceFeatures(source.features);
    method.setInputTarget(target.points);
    method.setTargetFeatures(target.features);
    method.setMinSampleDistance(0.3F);
    method.setMaxCorrespondenceDistance(0.2);
    method.setMaximumIterations(500);
    Plain out;
    method.align(out);
  };
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

}  // namespace

Contenders pcl_registration() {
  return {{"global, by features, of a room", "PCL prerejective RANSAC", prerejective},
          {"by point feature histograms", "PCL SAC-IA", initial_alignment},
          {"SVD of 1,000 pairs", "PCL", svd}};
}

}  // namespace bench
