// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <limits>
#include <velum/testing.hpp>

#include "open3d_clouds.hpp"

namespace bench {
namespace {

namespace registration = open3d::pipelines::registration;
using open3d_clouds::convert;

constexpr double kCell = 0.2;  // about 4,000 cells of the room [m]
constexpr double kAnyError = std::numeric_limits<double>::infinity();

Prepare icp(const std::shared_ptr<registration::TransformationEstimation>& metric) {
  return [=](const Input& input) {
    return [=, source = convert(input.moved), target = convert(input.normals)] {
      registration::RegistrationICP(*source, *target, 0.2, Eigen::Matrix4d::Identity(), *metric,
                                    registration::ICPConvergenceCriteria(0.0, 0.0, 25));
    };
  };
}

/// Thinned points with normals, and their features.
struct Described {
  explicit Described(const open3d_clouds::Cloud& cloud) : points(cloud.VoxelDownSample(kCell)) {
    points->EstimateNormals(open3d::geometry::KDTreeSearchParamKNN(20));
    features = registration::ComputeFPFHFeature(
        *points, open3d::geometry::KDTreeSearchParamHybrid(5.0 * kCell, 100));
  }
  std::shared_ptr<open3d_clouds::Cloud> points;
  std::shared_ptr<registration::Feature> features;
};

std::function<void()> global(const Input& input) {
  return [from = convert(input.other), to = convert(input.scene)] {
    const Described source(*from);
    const Described target(*to);
    constexpr double kNear = 1.5 * kCell;
    const registration::CorrespondenceCheckerBasedOnEdgeLength edges(0.9);
    const registration::CorrespondenceCheckerBasedOnDistance near(kNear);
    registration::RegistrationRANSACBasedOnFeatureMatching(
        *source.points, *target.points, *source.features, *target.features, true, kNear,
        registration::TransformationEstimationPointToPoint(false), 3, {edges, near},
        registration::RANSACConvergenceCriteria(100000, 0.999));
  };
}

std::function<void()> fast_global(const Input& input) {
  return [from = convert(input.other), to = convert(input.scene)] {
    const Described source(*from);
    const Described target(*to);
    registration::FastGlobalRegistrationBasedOnFeatureMatching(*source.points, *target.points,
                                                               *source.features, *target.features);
  };
}

std::function<void()> ball_pivoting(const Input& input) {
  return [cloud = convert(input.smooth), radius = input.radius] {
    open3d::geometry::TriangleMesh::CreateFromPointCloudBallPivoting(
        *cloud, {0.25 * radius, 0.5 * radius, radius});
  };
}

std::function<void()> poisson(const Input& input) {
  return [cloud = convert(input.smooth)] {
    open3d::geometry::TriangleMesh::CreateFromPointCloudPoisson(*cloud, 8);
  };
}

std::function<void()> decimation(const Input& input) {
  const auto mesh = velum::test::Stage("meshing.delaunay_projected").run(input.smooth).mesh();
  open3d::geometry::TriangleMesh same;
  same.vertices_ = convert(mesh.vertices().without(velum::column::kNormals))->points_;
  for (velum::Index i = 0; i < mesh.size(); ++i) same.triangles_.push_back(mesh.triangles().col(i));
  return [same] {
    same.SimplifyQuadricDecimation(static_cast<int>(same.triangles_.size() / 2), kAnyError, 1.0);
  };
}

}  // namespace

Contenders open3d_surfaces() {
  using registration::TransformationEstimationPointToPlane;
  using registration::TransformationEstimationPointToPoint;
  constexpr double kTukey = 4.685 * 0.004;  // for the noise of the clouds [m]
  const auto tukey = std::make_shared<registration::TukeyLoss>(kTukey);
  return {{"ICP point to point, 25 iterations", "Open3D",
           icp(std::make_shared<TransformationEstimationPointToPoint>())},
          {"ICP point to plane, 25 iterations", "Open3D",
           icp(std::make_shared<TransformationEstimationPointToPlane>())},
          {"ICP point to plane, Tukey, 25 iterations", "Open3D",
           icp(std::make_shared<TransformationEstimationPointToPlane>(tukey))},
          {"global, by features, of a room", "Open3D RANSAC", global},
          {"global, by features, of a room", "Open3D fast global", fast_global},
          {"meshing", "Open3D ball pivoting", ball_pivoting},
          {"PCL's Poisson wrapped, depth 8", "Open3D", poisson},
          {"repair and decimate to half", "Open3D, decimation", decimation}};
}

}  // namespace bench
