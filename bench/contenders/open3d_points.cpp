// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "open3d_clouds.hpp"

namespace bench {
namespace {

using open3d_clouds::Cloud;
using open3d_clouds::convert;

std::function<void()> normals(const Input& input) {
  return [cloud = convert(input.cloud)] {
    cloud->EstimateNormals(open3d::geometry::KDTreeSearchParamKNN(50));
  };
}

std::function<void()> fpfh(const Input& input) {
  return [cloud = convert(input.normals)] {
    open3d::pipelines::registration::ComputeFPFHFeature(*cloud,
                                                        open3d::geometry::KDTreeSearchParamKNN(50));
  };
}

std::function<void()> statistical(const Input& input) {
  return [cloud = convert(input.cloud)] { cloud->RemoveStatisticalOutliers(50, 2.0); };
}

std::function<void()> radius_outliers(const Input& input) {
  return [cloud = convert(input.cloud), radius = input.radius] {
    cloud->RemoveRadiusOutliers(10, radius);
  };
}

std::function<void()> overlap(const Input& input) {
  return [cloud = convert(input.cloud), other = convert(input.moved), radius = input.radius] {
    const std::vector<double> distances = cloud->ComputePointCloudDistance(*other);
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < distances.size(); ++i)
      if (distances[i] > radius) kept.push_back(i);
    cloud->SelectByIndex(kept);
  };
}

std::function<void()> distances(const Input& input) {
  return [cloud = convert(input.moved), other = convert(input.normals)] {
    cloud->ComputePointCloudDistance(*other);
  };
}

std::function<void()> voxel_grid(const Input& input) {
  return [cloud = convert(input.cloud), edge = input.radius] { cloud->VoxelDownSample(edge); };
}

std::function<void()> density_clusters(const Input& input) {
  return [cloud = convert(input.scene), gap = input.gap] { cloud->ClusterDBSCAN(gap, 2); };
}

Prepare reader(const std::string& name) {
  return [=](const Input& input) {
    return [file = input.folder + "/" + name] {
      Cloud out;
      if (!open3d::io::ReadPointCloud(file, out))
        throw std::runtime_error("Open3D cannot read " + file);
    };
  };
}

}  // namespace

Contenders open3d_points() {
  open3d::utility::SetVerbosityLevel(open3d::utility::VerbosityLevel::Error);
  return {{"normals, k = 50", "Open3D", normals},
          {"FPFH, k = 50", "Open3D", fpfh},
          {"statistical outliers, k = 50", "Open3D", statistical},
          {"radius outliers", "Open3D", radius_outliers},
          {"overlap of two clouds", "Open3D", overlap},
          {"cloud to cloud", "Open3D, distances only", distances},
          {"voxel grid", "Open3D", voxel_grid},
          {"Euclidean clusters of a room", "Open3D DBSCAN", density_clusters, kSlow},
          {"read PCD, binary", "Open3D", reader("cloud.pcd")},
          {"read PCD, text", "Open3D", reader("cloud_ascii.pcd")},
          {"read PLY, binary", "Open3D", reader("cloud.ply")},
          {"read XYZ, text", "Open3D", reader("cloud.xyz")}};
}

}  // namespace bench
