// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "sail/curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sail/penalised.hpp"

namespace velum::sail {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr Index kSamples = 400;
constexpr double kIndependent = 60.0;  // points of a side that err independently, at most

Matrix3Xd sample(const MatrixXd& coefficients, Index spans) {
  Matrix3Xd points(3, kSamples + 1);
  for (Index i = 0; i <= kSamples; ++i)
    points.col(i) =
        (basis(static_cast<double>(i) / static_cast<double>(kSamples), spans) * coefficients)
            .transpose();
  return points;
}

double median(const VectorXd& values) {
  std::vector<double> sorted(values.data(), values.data() + values.size());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

}  // namespace

double Curve::length() const {
  if (empty()) return 0.0;
  const Index n = points_.cols() - 1;
  return (points_.rightCols(n) - points_.leftCols(n)).colwise().norm().sum();
}

Vector3d Curve::start_direction() const {
  // Over 2.5 %: the very end of a fitted curve is its least certain part.
  const Index to = std::min<Index>(points_.cols() - 1, 10);
  return (points_.col(to) - points_.col(0)).normalized();
}

Vector3d Curve::end_direction() const {
  return -reversed().start_direction();
}

Curve Curve::reversed() const {
  return Curve(points_.rowwise().reverse());
}

Curve Curve::ending_at(const Vector3d& end) const {
  const Vector3d direction = end_direction();
  Index kept = points_.cols();
  while (kept > 1 && (points_.col(kept - 1) - end).dot(direction) > 0.0) --kept;
  Matrix3Xd points(3, kept + 1);
  points << points_.leftCols(kept), end;
  return Curve(std::move(points));
}

Curve Curve::starting_at(const Vector3d& start) const {
  return reversed().ending_at(start).reversed();
}

std::optional<Vector3d> Curve::at_height(double z) const {
  for (Index i = 0; i + 1 < points_.cols(); ++i) {
    const double a = points_(2, i) - z;
    const double b = points_(2, i + 1) - z;
    if ((a <= 0.0) == (b <= 0.0) && a != 0.0) continue;
    const double share = a == b ? 0.0 : a / (a - b);
    return points_.col(i) + share * (points_.col(i + 1) - points_.col(i));
  }
  return std::nullopt;
}

double Curve::nearest(const Vector3d& p) const {
  double best = std::numeric_limits<double>::infinity();
  double at = 0.0;
  for (Index i = 0; i + 1 < points_.cols(); ++i) {
    const Vector3d a = points_.col(i);
    const Vector3d edge = points_.col(i + 1) - a;
    const double square = edge.squaredNorm();
    const double s = square > 0.0 ? std::clamp((p - a).dot(edge) / square, 0.0, 1.0) : 0.0;
    const double distance = (a + s * edge - p).squaredNorm();
    if (distance >= best) continue;
    best = distance;
    at = static_cast<double>(i) + s;
  }
  return at / static_cast<double>(points_.cols() - 1);
}

Curve smooth_curve(const Matrix3Xd& points, VectorXd share, const VectorXd& weights) {
  const Index n = points.cols();
  const Index spans = std::clamp<Index>(n / 6, 1, 12);
  const MatrixXd penalty = difference_penalty(spans + 3, 3);
  VectorXd trust = weights;
  Curve curve;
  // The places along the curve follow from the curve itself: twice is enough.
  for (int round = 0; round < 3; ++round) {
    MatrixXd design(n, spans + 3);
    for (Index i = 0; i < n; ++i) design.row(i) = basis(share[i], spans);
    const Fit fit = fit_penalised(design, points.transpose(), trust, penalty, kIndependent);
    curve = Curve(sample(fit.coefficients, spans));
    const VectorXd off = (points.transpose() - design * fit.coefficients).rowwise().norm();
    const double usual = median(off);
    for (Index i = 0; i < n; ++i) {
      share[i] = curve.nearest(points.col(i));
      // Points of another side, or of a thread that flies off the sail, count little.
      const double ratio = usual > 0.0 ? off[i] / (4.0 * usual) : 0.0;
      trust[i] = weights[i] / (1.0 + ratio * ratio * ratio * ratio);
    }
  }
  return curve;
}

}  // namespace velum::sail
