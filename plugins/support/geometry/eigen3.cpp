// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "geometry/eigen3.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace velum::geometry {
namespace {

// Turns the (p, q) entry of `a` to zero and carries the rotation into `v`.
void rotate(Eigen::Matrix3d& a, Eigen::Matrix3d& v, int p, int q) {
  const double apq = a(q, p);
  if (apq == 0.0) return;
  const double theta = (a(q, q) - a(p, p)) / (2.0 * apq);
  // The smaller root of t² + 2θt − 1 = 0, without overflow for large θ.
  const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
  const double c = 1.0 / std::sqrt(t * t + 1.0);
  const double s = t * c;
  const int r = 3 - p - q;
  const double arp = r > p ? a(r, p) : a(p, r);
  const double arq = r > q ? a(r, q) : a(q, r);
  a(p, p) -= t * apq;
  a(q, q) += t * apq;
  a(q, p) = 0.0;
  (r > p ? a(r, p) : a(p, r)) = c * arp - s * arq;
  (r > q ? a(r, q) : a(q, r)) = s * arp + c * arq;
  const Eigen::Vector3d vp = v.col(p);
  v.col(p) = c * vp - s * v.col(q);
  v.col(q) = s * vp + c * v.col(q);
}

}  // namespace

Eigen3 eigen3(const Eigen::Matrix3d& matrix) {
  // Scaled to unit size, so that neither tiny nor huge clouds under- or overflow.
  const double scale = matrix.cwiseAbs().maxCoeff();
  if (!(scale > 0.0)) return {Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()};
  Eigen::Matrix3d a = matrix / scale;
  Eigen::Matrix3d v = Eigen::Matrix3d::Identity();
  // Convergence is quadratic: six sweeps are more than any 3×3 matrix needs.
  for (int sweep = 0; sweep < 10; ++sweep) {
    if (std::abs(a(1, 0)) + std::abs(a(2, 0)) + std::abs(a(2, 1)) < 1e-300) break;
    rotate(a, v, 0, 1);
    rotate(a, v, 0, 2);
    rotate(a, v, 1, 2);
  }
  std::array<int, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return a(i, i) < a(j, j); });
  Eigen3 result;
  for (int i = 0; i < 3; ++i) {
    const int from = order[static_cast<std::size_t>(i)];
    result.values[i] = a(from, from) * scale;
    result.vectors.col(i) = v.col(from);
  }
  return result;
}

Eigen::Vector3d eigenvalues3(const Eigen::Matrix3d& matrix) {
  const double scale = matrix.cwiseAbs().maxCoeff();
  if (!(scale > 0.0)) return Eigen::Vector3d::Zero();
  const Eigen::Matrix3d a = matrix / scale;
  // Trigonometric solution of the characteristic cubic about the mean eigenvalue (Smith, 1961).
  const double mean = a.trace() / 3.0;
  const double d0 = a(0, 0) - mean, d1 = a(1, 1) - mean, d2 = a(2, 2) - mean;
  const double o = a(1, 0) * a(1, 0) + a(2, 0) * a(2, 0) + a(2, 1) * a(2, 1);
  const double p = std::sqrt((d0 * d0 + d1 * d1 + d2 * d2 + 2.0 * o) / 6.0);
  if (!(p > 0.0)) return Eigen::Vector3d::Constant(mean * scale);
  const double det = d0 * (d1 * d2 - a(2, 1) * a(2, 1)) -
                     a(1, 0) * (a(1, 0) * d2 - a(2, 1) * a(2, 0)) +
                     a(2, 0) * (a(1, 0) * a(2, 1) - d1 * a(2, 0));
  const double r = std::clamp(det / (2.0 * p * p * p), -1.0, 1.0);
  const double phi = std::acos(r) / 3.0;
  const double high = mean + 2.0 * p * std::cos(phi);
  const double low = mean + 2.0 * p * std::cos(phi + 2.0 * std::numbers::pi / 3.0);
  return scale * Eigen::Vector3d(low, 3.0 * mean - high - low, high);
}

Eigen::Vector3d smallest_eigenvector3(const Eigen::Matrix3d& matrix,
                                      const Eigen::Vector3d& values) {
  if (values[1] - values[0] < 1e-5 * values[2] || !(values[2] > 0.0))
    return eigen3(matrix).vectors.col(0);
  Eigen::Matrix3d m = matrix.selfadjointView<Eigen::Lower>();
  m.diagonal().array() -= values[0];
  // The columns of M − λ0·I span the plane normal to the eigenvector: the largest cross product of
  // two of them is the best conditioned.
  const Eigen::Vector3d c0 = m.col(0).cross(m.col(1));
  const Eigen::Vector3d c1 = m.col(1).cross(m.col(2));
  const Eigen::Vector3d c2 = m.col(2).cross(m.col(0));
  const double n0 = c0.squaredNorm(), n1 = c1.squaredNorm(), n2 = c2.squaredNorm();
  const Eigen::Vector3d& best = n0 >= n1 ? (n0 >= n2 ? c0 : c2) : (n1 >= n2 ? c1 : c2);
  const double norm = best.norm();
  if (!(norm > 0.0)) return eigen3(matrix).vectors.col(0);
  return best / norm;
}

}  // namespace velum::geometry
