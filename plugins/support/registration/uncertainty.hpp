// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "registration/normal_equations.hpp"
#include "velum/context.hpp"
#include "velum/table.hpp"

namespace velum::registration {

class WeighedPairs;

/// How well a pose is known. Turns are taken about `centre`, the source's barycentre under the
/// pose; a vector of six is a turn [rad] and a shift of that centre [m], along the target's axes.
struct Uncertainty {
  /// How firmly the surfaces fix each direction of motion, whatever metric found the pose: points
  /// may slide along their tangent planes.
  NormalEquations::Directions directions;
  /// Standard deviation along each of these directions [m]; infinite where it is free.
  Vector6 deviation;
  /// Of the pose; the free directions are left out of it.
  Matrix6 covariance = Matrix6::Zero();
  int free = 0;  ///< directions that the data leave free
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();

  /// Largest standard deviations of the turn [rad] and of the centre's place [m] over all axes.
  [[nodiscard]] double rotation() const;
  [[nodiscard]] double translation() const;
};

/// Directions fixed less than this, relative to one that every pair fixes, are as good as free:
/// normals that are wrong by some degrees fix as much.
constexpr double kFreeStrength = 1e-3;

/// From the pairs at the end: H⁻¹ M H⁻¹, H the information of the surfaces and M the scatter of the
/// pairs' pulls. Pulls of one target point are added up before they are squared, for its error is
/// theirs together. Without normals of the target, H is made of planes through the surroundings of
/// some of its points. `radius` [m] measures turns as arcs.
Uncertainty estimate_uncertainty(const WeighedPairs& pairs, const NormalEquations* surfaces,
                                 const Eigen::Vector3d& centre, double radius, Context& context);

/// One row a direction, the least certain first: strength, deviation, whether free, its turn and
/// shift.
Table directions_table(const Uncertainty& uncertainty);
/// The covariance, one row a parameter.
Table covariance_table(const Uncertainty& uncertainty);

}  // namespace velum::registration
