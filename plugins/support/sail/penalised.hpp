// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace velum::sail {

/// Values at `u` of the cubic B-splines over `spans` equal spans of [0, 1]: spans + 3 of them, of
/// which four are not zero. Beyond the ends the first and last span's polynomials go on.
[[nodiscard]] Eigen::RowVectorXd basis(double u, Eigen::Index spans);
/// Their derivatives by u.
[[nodiscard]] Eigen::RowVectorXd basis_slope(double u, Eigen::Index spans);

/// Sum of squares of differences of `order` between neighbouring coefficients (Eilers and Marx,
/// Flexible smoothing with B-splines and penalties, 1996).
[[nodiscard]] Eigen::MatrixXd difference_penalty(Eigen::Index count, Eigen::Index order);

struct Fit {
  Eigen::MatrixXd coefficients;  ///< one column a target
  double freedom = 0.0;          ///< effective number of parameters
};

/// Weighted least squares of `targets` on the columns of `design`, with weight λ on `penalty`; λ is
/// the one of least generalised cross-validation (Craven and Wahba, 1979). The rows count as
/// `independent` observations at most: points that were smoothed before have errors in common,
/// which plain cross-validation takes for shape.
[[nodiscard]] Fit fit_penalised(const Eigen::MatrixXd& design, const Eigen::MatrixXd& targets,
                                const Eigen::VectorXd& weights, const Eigen::MatrixXd& penalty,
                                double independent);

}  // namespace velum::sail
