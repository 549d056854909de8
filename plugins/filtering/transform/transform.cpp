// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <velum/stage.hpp>

#include "geometry/motion.hpp"

namespace {

using velum::Error;
using velum::Fault;
using velum::Pose;

/// A matrix whose rotation misses being one by more than this was not meant as one.
constexpr double kRigid = 1e-4;

struct Transform {
  std::optional<velum::Place> translation;
  std::optional<Eigen::Vector3d> axis;
  velum::Angle angle;
  std::vector<velum::Angle> rpy;
  std::vector<double> matrix;
  bool inverse = false;

  static auto about() {
    return velum::About<Transform>("Moves a cloud, its normals and its sensors rigidly.")
        .in("cloud")
        .in("transform", "from another stage; without it the parameters say how to move")
        .out("cloud")
        .param(&Transform::translation, "translation", "shift, after the rotation")
        .param(&Transform::axis, "axis", "axis of the rotation, through the frame's origin")
        .param(&Transform::angle, "angle", "about `axis`")
        .param(&Transform::rpy, "rpy",
               "roll, pitch, yaw: about x, then y, then z, of the fixed frame; instead of `axis`")
        .param(&Transform::matrix, "matrix",
               "16 numbers, row by row, with the shift in metres; instead of all of the above")
        .param(&Transform::inverse, "inverse", "move the other way")
        .deterministic();
  }

  void check() const { static_cast<void>(given()); }

  velum::Cloud operator()(const velum::Cloud& cloud,
                          const std::optional<velum::Transform>& transform,
                          velum::Context& context) const {
    context.check();
    const Pose pose = transform ? only(transform->matrix) : given();
    context.measure("rotation", velum::geometry::angle_of(pose.linear()), "rad");
    context.measure("translation", pose.translation().norm(), "m");
    return cloud.transformed(inverse ? pose.inverse() : pose);
  }

 private:
  [[nodiscard]] bool has_parts() const { return translation || axis || !rpy.empty(); }

  [[nodiscard]] Pose only(const Pose& wired) const {
    if (has_parts() || !matrix.empty())
      throw Error(Fault::graph, "the transform is given twice: by a wire and by parameters");
    return wired;
  }

  [[nodiscard]] Pose given() const {
    if (!matrix.empty()) return from_matrix();
    if (axis && !rpy.empty())
      throw Error(Fault::graph, "the rotation is given twice: by 'axis' and by 'rpy'").at("rpy");
    Pose pose = Pose::Identity();
    if (axis) pose.linear() = about_axis();
    if (!rpy.empty()) pose.linear() = from_rpy();
    if (translation) pose.translation() = translation->metres;
    return pose;
  }

  [[nodiscard]] Eigen::Matrix3d about_axis() const {
    if (!(axis->norm() > 0.0)) throw Error(Fault::graph, "'axis' has no length").at("axis");
    return Eigen::AngleAxisd(angle, axis->normalized()).toRotationMatrix();
  }

  [[nodiscard]] Eigen::Matrix3d from_rpy() const {
    if (rpy.size() != 3)
      throw Error(Fault::graph, fmt::format("'rpy' has {} angles, it needs 3", rpy.size()))
          .at("rpy");
    return (Eigen::AngleAxisd(rpy[2], Eigen::Vector3d::UnitZ()) *
            Eigen::AngleAxisd(rpy[1], Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(rpy[0], Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
  }

  [[nodiscard]] Pose from_matrix() const {
    if (has_parts())
      throw Error(Fault::graph, "the transform is given twice: by 'matrix' and by its parts")
          .at("matrix");
    if (matrix.size() != 16)
      throw Error(Fault::graph, fmt::format("'matrix' has {} numbers, it needs 16", matrix.size()))
          .at("matrix");
    Eigen::Matrix4d m;
    for (int i = 0; i < 16; ++i) m(i / 4, i % 4) = matrix[static_cast<std::size_t>(i)];
    const Eigen::Matrix3d rotation = m.topLeftCorner<3, 3>();
    const double off = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm();
    if (!(off < kRigid) || rotation.determinant() < 0.0 ||
        m.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0))
      throw Error(Fault::graph,
                  "'matrix' is not a rigid motion: a rotation in its first three rows "
                  "and columns, 0 0 0 1 in the last row")
          .at("matrix");
    Pose pose = Pose::Identity();
    pose.linear() = velum::geometry::orthonormal(rotation);
    pose.translation() = m.topRightCorner<3, 1>();
    return pose;
  }
};

}  // namespace
VELUM_STAGE(Transform)
