// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/pair_sums.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/rigid_fit.hpp"

namespace velum::registration {
namespace {

constexpr Index kGrain = 4096;
/// Weaker directions carry nothing but rounding; moving along them would only wander.
constexpr double kCutoff = 1e-5;

}  // namespace

void PairSums::add(const Pair& pair) {
  const Eigen::Vector3d p = pair.point - planes_.centre();
  ++pairs_;
  weight_ += pair.weight;
  squares_ += pair.weight * (pair.target - pair.point).squaredNorm();
  from_ += pair.weight * p;
  spread_.noalias() += (pair.weight * p) * p.transpose();
  if (metric_ == Metric::point_to_point) {
    const Eigen::Vector3d q = pair.target - planes_.centre();
    to_ += pair.weight * q;
    correlation_.noalias() += (pair.weight * p) * q.transpose();
  } else {
    planes_.add(pair.at, pair.normal, pair.gap, pair.weight);
  }
}

void PairSums::add(const PairSums& other) {
  pairs_ += other.pairs_;
  weight_ += other.weight_;
  squares_ += other.squares_;
  from_ += other.from_;
  to_ += other.to_;
  correlation_ += other.correlation_;
  spread_ += other.spread_;
  planes_.add(other.planes_);
}

double PairSums::error() const {
  return metric_ == Metric::point_to_point ? fitness() : planes_.mean_square();
}

double PairSums::radius() const {
  return std::sqrt(std::max(0.0, spread_.trace() / weight_ - (from_ / weight_).squaredNorm()));
}

NormalEquations PairSums::equations() const {
  if (metric_ != Metric::point_to_point) return planes_;
  // Sums of the rows (p × e, e) over the three axes e of each pair.
  Matrix6 matrix = Matrix6::Zero();
  matrix.topLeftCorner<3, 3>() = spread_.trace() * Eigen::Matrix3d::Identity() - spread_;
  matrix.topRightCorner<3, 3>() << 0.0, -from_.z(), from_.y(), from_.z(), 0.0, -from_.x(),
      -from_.y(), from_.x(), 0.0;
  matrix.bottomLeftCorner<3, 3>() = matrix.topRightCorner<3, 3>().transpose();
  matrix.bottomRightCorner<3, 3>() = weight_ * Eigen::Matrix3d::Identity();
  Vector6 right;
  right << correlation_(1, 2) - correlation_(2, 1), correlation_(2, 0) - correlation_(0, 2),
      correlation_(0, 1) - correlation_(1, 0), to_ - from_;
  NormalEquations equations(planes_.centre());
  equations.add(matrix, right, squares_, weight_);
  return equations;
}

/// By singular value decomposition (thesis 3.5 to 3.11, 3.17).
Pose PairSums::decomposed() const {
  const Eigen::Vector3d& centre = planes_.centre();
  const Eigen::Vector3d from = from_ / weight_;
  const Eigen::Vector3d to = to_ / weight_;
  Pose pose = Pose::Identity();
  pose.linear() = geometry::best_rotation(correlation_ / weight_ - from * to.transpose());
  pose.translation() = centre + to - pose.linear() * (centre + from);
  return pose;
}

Pose PairSums::motion(Solver solver) const {
  if (solver == Solver::svd || (solver == Solver::automatic && metric_ == Metric::point_to_point))
    return decomposed();
  const NormalEquations equations = this->equations();
  const Vector6 twist = equations.twist(radius(), kCutoff);
  return solver == Solver::linearised ? euler_motion(twist, equations.centre())
                                      : geometry::exponential(twist, equations.centre());
}

PairSums sum_pairs(const WeighedPairs& pairs, const Eigen::Vector3d& centre, Metric metric,
                   Context& context) {
  const auto part = [&](Index begin, Index end) {
    PairSums sums(centre, metric);
    Pair pair;
    for (Index i = begin; i < end; ++i)
      if (pairs.get(i, pair)) sums.add(pair);
    return sums;
  };
  return parallel_reduce(context, pairs.size(), kGrain, PairSums(centre, metric), part,
                         [](PairSums& total, const PairSums& one) { total.add(one); });
}

}  // namespace velum::registration
