// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "registration/normal_equations.hpp"
#include "registration/weighed_pairs.hpp"

namespace velum::registration {

/// What one pass over the pairs gives: weighted sums about a fixed centre, for every solver.
class PairSums {
 public:
  PairSums(const Eigen::Vector3d& centre, Metric metric) : metric_(metric), planes_(centre) {}

  void add(const Pair& pair);
  void add(const PairSums& other);

  [[nodiscard]] Index pairs() const { return pairs_; }
  [[nodiscard]] double weight() const { return weight_; }
  /// Mean squared distance of the pairs [m²].
  [[nodiscard]] double fitness() const { return squares_ / weight_; }
  /// Mean squared gap by the metric [m²].
  [[nodiscard]] double error() const;
  /// RMS distance of the paired source points from their centroid [m].
  [[nodiscard]] double radius() const;
  /// The equations of the metric for a small motion. Point to point counts every direction of a
  /// pair.
  [[nodiscard]] NormalEquations equations() const;
  /// The motion that the solver finds best for these pairs.
  [[nodiscard]] Pose motion(Solver solver) const;

 private:
  [[nodiscard]] Pose decomposed() const;

  Metric metric_;
  Index pairs_ = 0;
  double weight_ = 0.0;
  double squares_ = 0.0;
  Eigen::Vector3d from_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d correlation_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d spread_ = Eigen::Matrix3d::Zero();
  NormalEquations planes_;
};

/// Sums of all pairs that count, the same for any number of threads.
PairSums sum_pairs(const WeighedPairs& pairs, const Eigen::Vector3d& centre, Metric metric,
                   Context& context);

}  // namespace velum::registration
