// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "geometry/rigid_fit.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "geometry/eigen3.hpp"

namespace velum::geometry {
namespace {

/// Singular values below this share of the first one are rounding.
constexpr double kRank = 1e-12;

}  // namespace

Eigen::Matrix3d best_rotation(const Eigen::Matrix3d& correlation) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(correlation,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d values = svd.singularValues();
  if (!(values[0] > 0.0)) return Eigen::Matrix3d::Identity();
  if (values[1] <= kRank * values[0])  // one direction only: the shortest turn
    return Eigen::Quaterniond::FromTwoVectors(svd.matrixU().col(0), svd.matrixV().col(0))
        .toRotationMatrix();
  Eigen::Matrix3d v = svd.matrixV();
  if ((v * svd.matrixU().transpose()).determinant() < 0.0) v.col(2) *= -1.0;
  return v * svd.matrixU().transpose();
}

RigidFit rigid_fit(const Eigen::Matrix3Xd& source, const Eigen::Matrix3Xd& target,
                   std::span<const double> weights) {
  const auto weight = [&](Index i) {
    return weights.empty() ? 1.0 : weights[static_cast<std::size_t>(i)];
  };
  double total = 0.0;
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  for (Index i = 0; i < source.cols(); ++i) {
    total += weight(i);
    from += weight(i) * source.col(i);
    to += weight(i) * target.col(i);
  }
  from /= total;
  to /= total;
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (Index i = 0; i < source.cols(); ++i) {
    const Eigen::Vector3d p = source.col(i) - from;
    correlation += (weight(i) * p) * (target.col(i) - to).transpose();
    squares += (weight(i) * p) * p.transpose();
  }
  RigidFit fit;
  fit.spread = eigen3(squares / total).values.reverse().cwiseMax(0.0);
  fit.pose.linear() = best_rotation(correlation);
  fit.pose.translation() = to - fit.pose.linear() * from;
  double sum = 0.0;
  for (Index i = 0; i < source.cols(); ++i)
    sum += weight(i) *
           (fit.pose.linear() * (source.col(i) - from) - (target.col(i) - to)).squaredNorm();
  fit.rmse = std::sqrt(sum / total);
  return fit;
}

}  // namespace velum::geometry
