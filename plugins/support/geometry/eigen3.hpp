// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace velum::geometry {

/// Eigenvalues in ascending order and unit eigenvectors (columns, in the same order, a right-handed
/// or left-handed frame) of a symmetric matrix.
struct Eigen3 {
  Eigen::Vector3d values;
  Eigen::Matrix3d vectors;
};

/// All of them by cyclic Jacobi rotations: accurate to rounding for every symmetric matrix, equal
/// and zero eigenvalues included. Only the lower triangle is read. About 0.3 µs.
Eigen3 eigen3(const Eigen::Matrix3d& matrix);

/// The eigenvalues alone, ascending, in closed form. A simple eigenvalue is accurate to rounding of
/// the largest, two nearly equal ones to its square root. About 50 ns.
Eigen::Vector3d eigenvalues3(const Eigen::Matrix3d& matrix);

/// The unit eigenvector of the smallest eigenvalue, the normal of a covariance; `values` are those
/// of eigenvalues3. Falls back to Jacobi where the two smallest are too close for a cross product.
Eigen::Vector3d smallest_eigenvector3(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& values);

}  // namespace velum::geometry
