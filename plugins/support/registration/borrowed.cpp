// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/borrowed.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "geometry/rigid_fit.hpp"
#include "registration/pairs.hpp"

namespace velum::registration {
namespace {

/// Points by which a step is followed.
constexpr Index kFollowed = 64;
/// A matrix farther than this from a rotation is none.
constexpr double kSkew = 1e-2;

Eigen::Matrix3Xd followed(const ConstPoints& points) {
  const Index stride = std::max<Index>(1, points.cols() / kFollowed);
  Eigen::Matrix3Xd some(3, (points.cols() + stride - 1) / stride);
  for (Index i = 0; i < some.cols(); ++i) some.col(i) = points.col(i * stride).cast<double>();
  return some;
}

Eigen::Vector3d middle(const ConstPoints& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Index i = 0; i < points.cols(); ++i) sum += points.col(i).cast<double>();
  return sum / static_cast<double>(std::max<Index>(1, points.cols()));
}

}  // namespace

Borrowed::Borrowed(std::string what, const Cloud& source, const Cloud& target,
                   const std::optional<Transform>& initial, Index least)
    : what_(std::move(what)), given_(source) {
  for (const auto& [cloud, name] : {std::pair(&source, "source"), std::pair(&target, "target")})
    if (cloud->size() < least)
      throw Error(Fault::stage, fmt::format("the {} has {} points, {} needs at least {}", name,
                                            cloud->size(), what_, least));
  if (initial) initial_ = initial->matrix;
  const Eigen::Vector3d origin = target.origin() + middle(target.positions());
  target_ = target.with_origin(origin);
  source_ = source.transformed(initial_).with_origin(origin);
  before_ = followed(source_.positions());
}

void Borrowed::iteration(const ConstPoints& moved, Index pairs, double error, Context& context) {
  context.check();
  Eigen::Matrix3Xd now = followed(moved);
  const Eigen::Vector3d centre = middle(moved);
  if (!now.allFinite() || !centre.allFinite())
    throw Error(Fault::stage, what_ + " lost the source: its points are no longer finite")
        .hint("start nearer (initial), or set max_distance");
  const Pose step = geometry::rigid_fit(before_, now).pose;
  IcpStep record;
  record.pairs = pairs;
  record.error = error;
  record.relative_change = steps_.empty() ? std::numeric_limits<double>::quiet_NaN()
                                          : std::abs(steps_.back().error - error) /
                                                std::max(std::abs(steps_.back().error), 1e-300);
  record.rotation = geometry::angle_of(step.linear());
  record.translation = (now.rowwise().mean() - before_.rowwise().mean()).norm();
  record.barycentre = centre + target_.origin();
  steps_.push_back(record);
  before_ = std::move(now);
}

std::tuple<Cloud, Transform, Table> Borrowed::finish(const Eigen::Matrix4d& motion,
                                                     double max_distance, bool converged,
                                                     Context& context) const {
  const Eigen::Matrix3d turn = motion.topLeftCorner<3, 3>();
  if (!motion.allFinite() || !(turn.determinant() > 0.0) ||
      !((turn * turn.transpose() - Eigen::Matrix3d::Identity()).norm() < kSkew))
    throw Error(Fault::stage, what_ + " returned no rigid motion")
        .hint("start nearer (initial), or set max_distance");
  Pose local = Pose::Identity();
  local.linear() = geometry::orthonormal(turn);
  local.translation() = motion.topRightCorner<3, 1>();

  ClosestPairs pairs(source_.positions(), target_);
  pairs.update(local, max_distance, context);
  double squares = 0.0;
  for (Index i = 0; i < pairs.size(); ++i)
    if (pairs.match(i) >= 0) squares += pairs.distance(i) * pairs.distance(i);
  const Index count = pairs.count();
  if (count == 0)
    throw Error(Fault::stage, fmt::format("0 of {} source points have a target point within {:.6g} "
                                          "m after {}",
                                          pairs.size(), max_distance, what_))
        .hint("bring the clouds closer first (registration.planes, registration.svd)");

  Transform transform;
  transform.matrix = geometry::to_true(local, target_.origin(), target_.origin()) * initial_;
  transform.fitness = squares / static_cast<double>(count);
  transform.history = history_table(steps_);
  context.measure("fitness", transform.fitness, "m^2", Better::lower);
  context.measure("rmse", std::sqrt(transform.fitness), "m", Better::lower);
  context.measure("overlap", static_cast<double>(count) / static_cast<double>(pairs.size()), "",
                  Better::higher);
  context.measure("iterations", iterations(), "", Better::lower);
  context.measure("pairs", static_cast<double>(count), "");
  if (!converged)
    context.warn(fmt::format("ended after {} iterations without having converged", iterations()));
  return {given_.transformed(transform.matrix), transform, transform.history};
}

}  // namespace velum::registration
