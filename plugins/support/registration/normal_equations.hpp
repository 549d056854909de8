// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "geometry/motion.hpp"

namespace velum::registration {

using geometry::Matrix6;
using geometry::Vector6;

/// Least squares for the small motion (angular velocity, velocity at `centre`) that brings points
/// onto the tangent planes of their matches (Chen and Medioni 1991; thesis 3.20 to 3.24).
class NormalEquations {
 public:
  explicit NormalEquations(const Eigen::Vector3d& centre) : centre_(centre) {}

  /// A point that should move by `gap` along `normal`.
  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double gap,
           double weight = 1.0);
  /// Sums of many rows: Σ w·row·rowᵀ, Σ w·gap·row, Σ w·gap², Σ w.
  void add(const Matrix6& matrix, const Vector6& right, double squares, double weight);
  /// The same equations about the same centre.
  void add(const NormalEquations& other) {
    add(other.matrix_, other.right_, other.squares_, other.weight_);
  }
  /// As if every pair counted `times` as much.
  void scale(double times);

  [[nodiscard]] const Eigen::Vector3d& centre() const { return centre_; }
  [[nodiscard]] double weight() const { return weight_; }
  /// Weighted mean square of the gaps [m²].
  [[nodiscard]] double mean_square() const { return weight_ > 0.0 ? squares_ / weight_ : 0.0; }
  [[nodiscard]] const Matrix6& matrix() const { return matrix_; }

  /// How well the equations fix each direction of motion: eigenvalues of the matrix per unit of
  /// weight, turns measured as arc at `radius` [m] from the centre, ascending, in [0, 1] or so; 0
  /// is a direction in which the points can slide freely.
  struct Directions {
    Vector6 strength;
    Matrix6 axes;  ///< a column each: turn (times radius), then shift
    double radius;
  };
  [[nodiscard]] Directions directions(double radius) const;
  /// The motion as a turn and the shift of the centre; directions weaker than `cutoff` are left
  /// alone.
  [[nodiscard]] Vector6 twist(double radius, double cutoff) const;
  /// The helical motion of that twist.
  [[nodiscard]] Pose solve(double radius, double cutoff) const {
    return geometry::exponential(twist(radius, cutoff), centre_);
  }
  /// σ²·H⁻¹ with turns in arc at `radius`: the largest standard deviations [rad], [m] when each
  /// unit of weight is one measurement of deviation `sigma` [m]. Infinite where a direction is
  /// free.
  struct Deviations {
    double rotation;
    double translation;
  };
  [[nodiscard]] Deviations deviations(double radius, double sigma) const;

 private:
  Eigen::Vector3d centre_;
  Matrix6 matrix_ = Matrix6::Zero();
  Vector6 right_ = Vector6::Zero();
  double squares_ = 0.0;
  double weight_ = 0.0;
};

/// The motion that the thesis makes of a twist (3.25, 3.26): its turn as angles about x, y, z in
/// this order, then its shift. The same as the exponential to first order only.
Pose euler_motion(const Vector6& twist, const Eigen::Vector3d& centre);

/// "sliding along (0.00, 1.00, 0.00)" or "turning about (...)": what dominates a column of
/// Directions::axes.
std::string describe_direction(const Vector6& axis);

}  // namespace velum::registration
