// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "sail/penalised.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace velum::sail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

Index span_of(double u, Index spans) {
  return std::clamp<Index>(static_cast<Index>(std::floor(u * static_cast<double>(spans))), 0,
                           spans - 1);
}

}  // namespace

RowVectorXd basis(double u, Index spans) {
  const Index span = span_of(u, spans);
  const double x = u * static_cast<double>(spans) - static_cast<double>(span);
  const double y = 1.0 - x;
  RowVectorXd row = RowVectorXd::Zero(spans + 3);
  row.segment<4>(span) << y * y * y / 6.0, (3.0 * x * x * x - 6.0 * x * x + 4.0) / 6.0,
      (3.0 * y * y * y - 6.0 * y * y + 4.0) / 6.0, x * x * x / 6.0;
  return row;
}

RowVectorXd basis_slope(double u, Index spans) {
  const Index span = span_of(u, spans);
  const double x = u * static_cast<double>(spans) - static_cast<double>(span);
  const double y = 1.0 - x;
  RowVectorXd row = RowVectorXd::Zero(spans + 3);
  row.segment<4>(span) << -0.5 * y * y, 1.5 * x * x - 2.0 * x, 2.0 * y - 1.5 * y * y, 0.5 * x * x;
  return row * static_cast<double>(spans);
}

MatrixXd difference_penalty(Index count, Index order) {
  MatrixXd differences = MatrixXd::Identity(count, count);
  for (Index i = 0; i < order; ++i)
    differences = (differences.bottomRows(differences.rows() - 1) -
                   differences.topRows(differences.rows() - 1))
                      .eval();
  return differences.transpose() * differences;
}

Fit fit_penalised(const MatrixXd& design, const MatrixXd& targets, const VectorXd& weights,
                  const MatrixXd& penalty, double independent) {
  // Scaled to a mean weight of 1, so that the residual keeps its unit.
  const VectorXd scaled = weights * (static_cast<double>(weights.size()) / weights.sum());
  const MatrixXd weighted = scaled.asDiagonal() * design;
  MatrixXd normal = design.transpose() * weighted;
  const MatrixXd right = weighted.transpose() * targets;
  // A share of the penalty that is too small to matter keeps columns without data determined.
  const double scale = normal.trace() / std::max(penalty.trace(), 1e-300);
  normal += 1e-9 * scale * penalty;
  normal.diagonal().array() += 1e-12 * normal.trace() / static_cast<double>(normal.rows());

  // In the basis where both matrices are diagonal any λ costs a division.
  const Eigen::LLT<MatrixXd> cholesky(normal);
  const MatrixXd half = cholesky.matrixL().solve(penalty);
  const MatrixXd reduced = cholesky.matrixL().solve(half.transpose());
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(0.5 * (reduced + reduced.transpose()));
  const VectorXd roughness = eigen.eigenvalues().cwiseMax(0.0);
  const MatrixXd load = eigen.eigenvectors().transpose() * cholesky.matrixL().solve(right);
  const double total = (targets.transpose() * scaled.asDiagonal() * targets).trace();
  const double rows = std::min(static_cast<double>(design.rows()), independent);

  Fit best;
  double best_score = std::numeric_limits<double>::infinity();
  for (int step = 0; step <= 60; ++step) {
    const double lambda = scale * std::pow(10.0, -7.0 + 0.25 * step);
    const VectorXd shrink = (1.0 + lambda * roughness.array()).inverse();
    const MatrixXd kept = shrink.asDiagonal() * load;
    const double freedom = shrink.sum();
    const double squares =
        std::max(0.0, total - 2.0 * kept.cwiseProduct(load).sum() + kept.squaredNorm());
    const double left = rows - freedom;
    if (left <= 0.5) continue;
    const double score = squares / (left * left);
    if (score >= best_score) continue;
    best_score = score;
    best.freedom = freedom;
    best.coefficients = cholesky.matrixL().transpose().solve(eigen.eigenvectors() * kept);
  }
  return best;
}

}  // namespace velum::sail
