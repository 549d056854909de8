// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/SparseCore>
#include <optional>

#include "bspline/evaluate.hpp"

namespace velum::bspline {

using Sparse = Eigen::SparseMatrix<double>;

/// A row for each column of `places` with the tensor products of basis functions there; function
/// (i, j) is column i·count_v + j, as in Surface.
[[nodiscard]] Sparse design(const Surface& grid, const Eigen::Matrix2Xd& places);

/// Quadratic form of ∫∫ Σ C(m, a) (∂ᵐs / ∂xᵃ∂yᵐ⁻ᵃ)² dx dy over the whole range of parameters, where
/// x and y are u and v stretched to `width` and `height` [m] and m is `order`, at most the degree.
/// A surface whose roughness of order 2 is nil is plane; of order 3, it bends as a parabola: camber
/// is not flattened.
[[nodiscard]] Sparse roughness(const Surface& grid, double width, double height, int order);

struct Smoothed {
  Eigen::MatrixXd coefficients;  ///< one column a target
  double lambda = 0.0;
  double freedom = 0.0;  ///< effective number of parameters
  double squares = 0.0;  ///< weighted squares that are left
};

/// The c that minimises Σ w |y − A c|² + λ (cᵀ K c + 2 gᵀ c), by sparse Cholesky, with the λ of
/// least generalised cross-validation (Craven and Wahba, 1979), times `smoothness`; with the λ that
/// is given where one is. `load` is g; of no columns: zero. Throws Error (Fault::stage) when
/// nothing determines c.
[[nodiscard]] Smoothed smooth_fit(const Sparse& design, const Eigen::MatrixXd& targets,
                                  const Eigen::VectorXd& weights, const Sparse& penalty,
                                  const Eigen::MatrixXd& load, double smoothness,
                                  std::optional<double> lambda = std::nullopt);

}  // namespace velum::bspline
