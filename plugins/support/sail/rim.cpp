// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "sail/rim.hpp"

#include <algorithm>
#include <cmath>

namespace velum::sail {

using Eigen::Matrix2Xd;
using Eigen::Matrix3Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr Index kRimPoints = 2000;

// How much a polygon turns at a point [rad].
double turn_at(const Matrix3Xd& points, Index i) {
  const Index n = points.cols();
  const Vector3d in = points.col(i) - points.col((i + n - 1) % n);
  const Vector3d out = points.col((i + 1) % n) - points.col(i);
  return std::acos(std::clamp(in.normalized().dot(out.normalized()), -1.0, 1.0));
}

}  // namespace

std::vector<Matrix2Xd> loops_of(const bspline::Patch& patch) {
  if (!patch.surface().trimming.empty()) return patch.surface().trimming;
  const Vector2d low = patch.low();
  const Vector2d high = patch.high();
  Matrix2Xd rectangle(2, 4);
  rectangle << low.x(), high.x(), high.x(), low.x(), low.y(), low.y(), high.y(), high.y();
  return {rectangle};
}

Matrix2Xd refined(const bspline::Patch& patch, const Matrix2Xd& loop) {
  constexpr int kSteps = 16;
  const Index n = loop.cols();
  const auto on_side = [&](Index k, double share) -> Vector2d {
    return loop.col(k) + share * (loop.col((k + 1) % n) - loop.col(k));
  };
  std::vector<double> lengths;
  double total = 0.0;
  for (Index k = 0; k < n; ++k) {
    double length = 0.0;
    for (int i = 0; i < kSteps; ++i)
      length += (patch.at(on_side(k, (i + 1.0) / kSteps)) - patch.at(on_side(k, 1.0 * i / kSteps)))
                    .norm();
    lengths.push_back(length);
    total += length;
  }
  std::vector<Vector2d> places;
  for (Index k = 0; k < n; ++k) {
    const double share = lengths[static_cast<std::size_t>(k)] / total;
    if (!(share > 1e-9)) continue;
    const auto parts = static_cast<Index>(std::ceil(share * kRimPoints));
    for (Index i = 0; i < parts; ++i)
      places.push_back(on_side(k, static_cast<double>(i) / static_cast<double>(parts)));
  }
  if (places.size() < 8) throw Error(Fault::stage, "the surface's border encloses nothing");
  Matrix2Xd rim(2, static_cast<Index>(places.size()));
  for (Index i = 0; i < rim.cols(); ++i) rim.col(i) = places[static_cast<std::size_t>(i)];
  return rim;
}

Outline sharpened(const Outline& outline) {
  constexpr double kSharp = 0.3;  // [rad]
  const Index n = outline.points.cols();
  const auto window = static_cast<Index>(0.02 * static_cast<double>(n));
  std::vector<Index> sharp;  // from just before the tack, once round
  for (Index i = -window; i < n - window; ++i)
    if (turn_at(outline.points, (i + n) % n) > kSharp) sharp.push_back(i);
  const auto nearest = [&](Index corner) {
    const auto nearer = [&](Index a, Index b) {
      return std::abs(a - corner) < std::abs(b - corner);
    };
    const auto found = std::min_element(sharp.begin(), sharp.end(), nearer);
    return found != sharp.end() && std::abs(*found - corner) <= window ? *found : corner;
  };
  const Index tack = nearest(0);
  const auto moved = [&](Index corner) { return corner - tack; };
  Outline exact = outline;
  // Head and peak: the first and the last corner of the upper quarter.
  const double low = outline.points(2, 0);
  const double upper = low + 0.75 * (outline.points.row(2).maxCoeff() - low);
  std::vector<Index> top;
  for (const Index i : sharp)
    if (i > window && i < outline.clew && outline.points(2, i) > upper) top.push_back(i);
  exact.head = moved(top.empty() ? outline.head : top.front());
  exact.peak = moved(top.empty() ? outline.peak : top.back());
  exact.clew = moved(nearest(outline.clew));
  for (Index i = 0; i < n; ++i) {
    const Index from = (i + tack + n) % n;
    exact.points.col(i) = outline.points.col(from);
    exact.places[static_cast<std::size_t>(i)] = outline.places[static_cast<std::size_t>(from)];
  }
  exact.arc[0] = 0.0;
  for (Index i = 1; i < n; ++i)
    exact.arc[i] = exact.arc[i - 1] + (exact.points.col(i) - exact.points.col(i - 1)).norm();
  return exact;
}

}  // namespace velum::sail
