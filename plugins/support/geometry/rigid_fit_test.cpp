// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <numbers>
#include <vector>

#include "geometry/motion.hpp"
#include "geometry/plane_fit.hpp"
#include "geometry/rigid_fit.hpp"
#include "velum/random.hpp"

using namespace velum;
using namespace velum::geometry;

namespace {

Pose some_pose(double angle) {
  Pose pose = Pose::Identity();
  pose.linear() =
      Eigen::AngleAxisd(angle, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(3.0, -1.0, 12.0);
  return pose;
}

Eigen::Matrix3Xd random_points(Index n) {
  Random random(7);
  Eigen::Matrix3Xd points(3, n);
  for (double& x : points.reshaped()) x = random.uniform(-2.0, 2.0);
  return points;
}

Eigen::Matrix3Xd move(const Pose& pose, const Eigen::Matrix3Xd& points) {
  return (pose.linear() * points).colwise() + pose.translation();
}

}  // namespace

TEST_CASE("a rigid fit finds an exact motion, also a half turn") {
  for (const double angle : {0.0, 1e-9, 0.3, 2.0, std::numbers::pi}) {
    const Pose truth = some_pose(angle);
    const auto source = random_points(20);
    const RigidFit fit = rigid_fit(source, move(truth, source));
    CHECK(difference(fit.pose, truth).rotation < 1e-12);
    CHECK(difference(fit.pose, truth).translation < 1e-11);
    CHECK(fit.rmse < 1e-11);
    CHECK(fit.pose.linear().determinant() == Approx(1.0));
  }
}

TEST_CASE("a rigid fit of a mirrored set is still a rotation") {
  const auto source = random_points(30);
  Eigen::Matrix3Xd mirrored = source;
  mirrored.row(2) *= -1.0;
  const RigidFit fit = rigid_fit(source, mirrored);
  CHECK(fit.pose.linear().determinant() == Approx(1.0));
  CHECK(fit.rmse > 0.1);
}

TEST_CASE("points in a plane fix the motion, points on a line leave the smallest turn") {
  const Pose truth = some_pose(0.7);
  Eigen::Matrix3Xd flat = random_points(10);
  flat.row(2).setZero();
  CHECK(difference(rigid_fit(flat, move(truth, flat)).pose, truth).rotation < 1e-12);

  Eigen::Matrix3Xd line = Eigen::Matrix3Xd::Zero(3, 4);
  line.row(0) << 0.0, 1.0, 2.0, 5.0;
  const RigidFit shifted = rigid_fit(line, line.colwise() + Eigen::Vector3d(0, 1, 0));
  CHECK(angle_of(shifted.pose.linear()) < 1e-12);
  CHECK(shifted.spread[1] == Approx(0.0).margin(1e-15));
  const RigidFit turned = rigid_fit(line, move(truth, line));
  CHECK(turned.rmse < 1e-12);

  const RigidFit one = rigid_fit(line.leftCols(1), line.middleCols(3, 1));
  CHECK(one.pose.translation().isApprox(Eigen::Vector3d(5, 0, 0)));
  CHECK(one.pose.linear().isIdentity());
}

TEST_CASE("weights decide between pairs that disagree") {
  const auto source = random_points(6);
  Eigen::Matrix3Xd target = source;
  target.col(5) += Eigen::Vector3d(1, 1, 1);
  const std::vector<double> weights{1, 1, 1, 1, 1, 0};
  const RigidFit fit = rigid_fit(source, target, weights);
  CHECK(difference(fit.pose, Pose::Identity()).translation < 1e-12);
  CHECK(rigid_fit(source, target).rmse > 0.1);
}

TEST_CASE("moments give the plane, however far away and however they were joined") {
  for (const double far : {0.0, 1e6}) {
    const Eigen::Vector3d place(far, -far, far);
    PointMoments whole(place);
    PointMoments first(place + Eigen::Vector3d(1, 0, 0));
    PointMoments second(place);
    Random random(3);
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3d p =
          place + Eigen::Vector3d(random.uniform(), random.uniform(), 0.002 * random.gaussian());
      whole.add(p);
      (i % 2 == 0 ? first : second).add(p);
    }
    first.add(second);
    const PlaneFit plane = whole.plane();
    CHECK(std::abs(plane.normal.z()) > 0.9999);
    CHECK(plane.rms() == Approx(0.002).epsilon(0.15));
    CHECK(plane.curvature() < 1e-4);
    CHECK(first.plane().rms() == Approx(plane.rms()).epsilon(1e-6));
    CHECK((first.centroid() - whole.centroid()).norm() < 1e-9);
  }
}

TEST_CASE("the exponential is a helical motion and small angles lose nothing") {
  Vector6 twist;
  twist << 0, 0, std::numbers::pi / 2, 0, 0, 0.5;
  const Pose quarter = exponential(twist, Eigen::Vector3d(1, 0, 0));
  CHECK((quarter * Eigen::Vector3d(2, 0, 0)).isApprox(Eigen::Vector3d(1, 1, 0.5)));
  for (const double angle : {1e-9, 9.9e-5, 1.01e-4, 1e-2, 3.0}) {
    twist << angle, 0, 0, 1, 2, 3;
    const Pose pose = exponential(twist);
    CHECK(angle_of(pose.linear()) == Approx(angle).epsilon(1e-9));
    CHECK((pose.linear().transpose() * pose.linear()).isIdentity(1e-14));
    const Pose half = exponential(0.5 * twist);
    CHECK((half * half).isApprox(pose, 1e-12));
  }
}

TEST_CASE("poses about origins and true poses are the same motion") {
  const Eigen::Vector3d from(4e5, 5e6, 10);
  const Eigen::Vector3d to(-3, 2, 1);
  const Pose truth = some_pose(0.4);
  const Pose local = to_local(truth, from, to);
  const Eigen::Vector3d p(0.1, 0.2, 0.3);
  CHECK((local * p + to - truth * (p + from)).norm() < 1e-8);
  CHECK(difference(to_true(local, from, to), truth, from).translation < 1e-8);
}
