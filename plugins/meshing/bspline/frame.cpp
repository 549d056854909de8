// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "frame.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

namespace velum::meshing {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::Vector4d;
using Eigen::VectorXd;

constexpr Index kBands = 24;
constexpr double kNarrowest = 0.35;  // half width kept at a pointed head, of the widest

Vector4d powers(double v) {
  return {1.0, v, v * v, v * v * v};
}
Vector4d slopes(double v) {
  return {0.0, 1.0, 2.0 * v, 3.0 * v * v};
}

}  // namespace

SheetFrame::SheetFrame(const Eigen::Matrix2Xd& plane, const Vector2d& margin) {
  low_ = plane.row(1).minCoeff() - margin.y();
  height_ = plane.row(1).maxCoeff() + margin.y() - low_;
  VectorXd left = VectorXd::Constant(kBands, std::numeric_limits<double>::infinity());
  VectorXd right = -left;
  for (Index i = 0; i < plane.cols(); ++i) {
    const double v = (plane(1, i) - low_) / height_;
    const auto band = std::clamp<Index>(static_cast<Index>(v * kBands), 0, kBands - 1);
    left[band] = std::min(left[band], plane(0, i));
    right[band] = std::max(right[band], plane(0, i));
  }
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(kBands + 4, 4);
  Eigen::MatrixXd ends = Eigen::MatrixXd::Zero(kBands + 4, 2);
  for (Index b = 0; b < kBands; ++b) {
    if (!(right[b] >= left[b])) continue;
    rows.row(b) = powers((static_cast<double>(b) + 0.5) / kBands).transpose();
    ends.row(b) << 0.5 * (left[b] + right[b]), 0.5 * (right[b] - left[b]);
  }
  // A little reluctance to bend decides where bands are empty.
  rows.bottomRows(4).diagonal() << 0.0, 1e-3, 0.1, 0.3;
  const Eigen::MatrixXd fitted = rows.completeOrthogonalDecomposition().solve(ends);
  centre_ = fitted.col(0);
  half_ = fitted.col(1);
  double widest = 0.0;
  for (Index b = 0; b <= kBands; ++b)
    widest = std::max(widest, half_.dot(powers(static_cast<double>(b) / kBands)));
  floor_ = kNarrowest * std::max(widest, 0.02 * height_);

  double most = 1e-9;
  for (Index i = 0; i < plane.cols(); ++i) {
    const Middle middle = middle_at((plane(1, i) - low_) / height_);
    most = std::max(most, (std::abs(plane(0, i) - middle.centre) + margin.x()) / middle.half);
  }
  stretch_ = most;
  double sum = 0.0;
  for (Index b = 0; b <= kBands; ++b) sum += middle_at(static_cast<double>(b) / kBands).half;
  width_ = 2.0 * sum / (kBands + 1);
}

SheetFrame::Middle SheetFrame::middle_at(double v) const {
  const double half = half_.dot(powers(v));
  const double half_slope = half_.dot(slopes(v));
  // The larger of both, rounded where they meet.
  const double off = half - floor_;
  const double root = std::hypot(off, 0.3 * floor_);
  Middle middle{};
  middle.centre = centre_.dot(powers(v));
  middle.centre_slope = centre_.dot(slopes(v));
  middle.half = stretch_ * 0.5 * (half + floor_ + root);
  middle.half_slope = root > 0.0 ? stretch_ * 0.5 * (1.0 + off / root) * half_slope : 0.0;
  return middle;
}

Vector2d SheetFrame::to_uv(const Vector2d& q) const {
  const double v = (q.y() - low_) / height_;
  const Middle middle = middle_at(v);
  return {0.5 + 0.5 * (q.x() - middle.centre) / middle.half, v};
}

Vector2d SheetFrame::to_plane(const Vector2d& uv) const {
  const Middle middle = middle_at(uv.y());
  return {middle.centre + (2.0 * uv.x() - 1.0) * middle.half, low_ + uv.y() * height_};
}

Eigen::Matrix2d SheetFrame::jacobian(const Vector2d& uv) const {
  const Middle middle = middle_at(uv.y());
  Eigen::Matrix2d j;
  j << 2.0 * middle.half, middle.centre_slope + (2.0 * uv.x() - 1.0) * middle.half_slope, 0.0,
      height_;
  return j;
}

}  // namespace velum::meshing
