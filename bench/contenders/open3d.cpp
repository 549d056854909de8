// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <open3d/Open3D.h>

#include "timing.hpp"

namespace bench {
namespace {

using Cloud = open3d::geometry::PointCloud;

std::shared_ptr<Cloud> convert(const velum::Cloud& cloud) {
  auto out = std::make_shared<Cloud>();
  const auto p = cloud.positions();
  for (velum::Index i = 0; i < p.cols(); ++i) out->points_.push_back(p.col(i).cast<double>());
  if (cloud.has(velum::column::kNormals)) {
    const auto n = cloud.normals();
    for (velum::Index i = 0; i < n.cols(); ++i) out->normals_.push_back(n.col(i).cast<double>());
  }
  return out;
}

std::function<void()> normals(const Input& input) {
  return [cloud = convert(input.cloud)] {
    cloud->EstimateNormals(open3d::geometry::KDTreeSearchParamKNN(50));
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

template <class Metric>
std::function<void()> icp(const Input& input) {
  return [source = convert(input.moved), target = convert(input.normals)] {
    open3d::pipelines::registration::RegistrationICP(
        *source, *target, 0.2, Eigen::Matrix4d::Identity(), Metric(),
        open3d::pipelines::registration::ICPConvergenceCriteria(0.0, 0.0, 25));
  };
}

std::function<void()> ball_pivoting(const Input& input) {
  return [cloud = convert(input.smooth), radius = input.radius] {
    open3d::geometry::TriangleMesh::CreateFromPointCloudBallPivoting(
        *cloud, {0.25 * radius, 0.5 * radius, radius});
  };
}

std::function<void()> reader(const std::string& file) {
  return [file] {
    Cloud out;
    if (!open3d::io::ReadPointCloud(file, out))
      throw std::runtime_error("Open3D cannot read " + file);
  };
}

}  // namespace

std::vector<Contender> open3d_contenders() {
  open3d::utility::SetVerbosityLevel(open3d::utility::VerbosityLevel::Error);
  namespace registration = open3d::pipelines::registration;
  return {
      {"normals, k = 50", "Open3D", normals},
      {"statistical outliers, k = 50", "Open3D", statistical},
      {"radius outliers", "Open3D", radius_outliers},
      {"ICP point to point, 25 iterations", "Open3D",
       icp<registration::TransformationEstimationPointToPoint>},
      {"ICP point to plane, 25 iterations", "Open3D",
       icp<registration::TransformationEstimationPointToPlane>},
      {"meshing", "Open3D ball pivoting", ball_pivoting},
      {"read PCD, binary", "Open3D",
       [](const Input& i) { return reader(i.folder + "/cloud.pcd"); }},
      {"read PCD, ascii", "Open3D",
       [](const Input& i) { return reader(i.folder + "/cloud_ascii.pcd"); }},
      {"read PLY, binary", "Open3D",
       [](const Input& i) { return reader(i.folder + "/cloud.ply"); }},
  };
}

}  // namespace bench
