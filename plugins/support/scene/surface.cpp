// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "scene/surface.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>

namespace velum::scene {
namespace {

constexpr int kDegree = 3;
constexpr Index kAcross = 36;
constexpr Index kAlong = 72;

// Clamped uniform knots of `count` control points.
Eigen::VectorXd knots_of(Index count) {
  Eigen::VectorXd knots(count + kDegree + 1);
  const double spans = static_cast<double>(count - kDegree);
  for (Index i = 0; i < knots.size(); ++i)
    knots[i] = std::clamp(static_cast<double>(i - kDegree) / spans, 0.0, 1.0);
  return knots;
}

double greville(const Eigen::VectorXd& knots, Index i) {
  return knots.segment<kDegree>(i + 1).mean();
}

// One row a parameter: the values of all basis functions there (Cox and de Boor).
Eigen::MatrixXd collocation(const Eigen::VectorXd& knots, Index count) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
  for (Index row = 0; row < count; ++row) {
    const double x = greville(knots, row);
    Index span = kDegree;
    while (span + 1 < count && knots[span + 1] <= x) ++span;
    std::array<double, kDegree + 1> basis{1.0};
    for (Index d = 1; d <= kDegree; ++d) {
      double carry = 0.0;
      for (Index j = 0; j < d; ++j) {
        const double right = knots[span + 1 + j];
        const double left = knots[span + 1 + j - d];
        const double share = basis[static_cast<std::size_t>(j)] / (right - left);
        basis[static_cast<std::size_t>(j)] = carry + (right - x) * share;
        carry = (x - left) * share;
      }
      basis[static_cast<std::size_t>(d)] = carry;
    }
    for (Index j = 0; j <= kDegree; ++j)
      matrix(row, span - kDegree + j) = basis[static_cast<std::size_t>(j)];
  }
  return matrix;
}

}  // namespace

Surface surface_of(const Sail& sail, const Pose& motion) {
  Surface surface;
  surface.knots_u = knots_of(kAcross);
  surface.knots_v = knots_of(kAlong);
  const Eigen::PartialPivLU<Eigen::MatrixXd> across(collocation(surface.knots_u, kAcross));
  const Eigen::PartialPivLU<Eigen::MatrixXd> along(collocation(surface.knots_v, kAlong));
  surface.control.resize(3, kAcross * kAlong);
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::MatrixXd values(kAcross, kAlong);
    for (Index i = 0; i < kAcross; ++i)
      for (Index j = 0; j < kAlong; ++j)
        values(i, j) =
            (motion * sail.point(greville(surface.knots_u, i), greville(surface.knots_v, j)))[axis];
    const Eigen::MatrixXd half = across.solve(values);
    const Eigen::MatrixXd control = along.solve(half.transpose());
    for (Index i = 0; i < kAcross; ++i)
      for (Index j = 0; j < kAlong; ++j) surface.control(axis, i * kAlong + j) = control(j, i);
  }
  return surface;
}

}  // namespace velum::scene
