// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "closing.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace velum::meshing {
namespace {

using Eigen::Vector2d;

// Where segments a b and c d cross, the share of the way from a to b.
std::optional<double> crossing(const Vector2d& a, const Vector2d& b, const Vector2d& c,
                               const Vector2d& d) {
  const Vector2d r = b - a;
  const Vector2d s = d - c;
  const double cross = r.x() * s.y() - r.y() * s.x();
  if (std::abs(cross) < 1e-300) return std::nullopt;
  const Vector2d gap = c - a;
  const double t = (gap.x() * s.y() - gap.y() * s.x()) / cross;
  const double w = (gap.x() * r.y() - gap.y() * r.x()) / cross;
  if (t < 0.0 || t > 1.0 || w < 0.0 || w > 1.0) return std::nullopt;
  return t;
}

// Where a polygon crosses itself, as luff and leech do above a pointed head, the shorter part is
// cut off. True when there was such a place.
bool cut_crossing(std::vector<Vector2d>& points) {
  const std::size_t n = points.size();
  for (std::size_t i = 0; i + 2 < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j + 1 == n) continue;
      const auto t = crossing(points[i], points[i + 1], points[j], points[(j + 1) % n]);
      if (!t) continue;
      const Vector2d at = points[i] + *t * (points[i + 1] - points[i]);
      const auto begin = points.begin();
      const auto from = static_cast<std::ptrdiff_t>(i + 1);
      const auto to = static_cast<std::ptrdiff_t>(j + 1);
      std::vector<Vector2d> left{at};
      if (2 * (j - i) < n) {
        left.insert(left.end(), begin + to, points.end());
        left.insert(left.end(), begin, begin + from);
      } else {
        left.insert(left.end(), begin + from, begin + to);
      }
      points = std::move(left);
      return true;
    }
  return false;
}

}  // namespace

TrimmingCurve closed(const sail::Border& border) {
  std::vector<Vector2d> points;
  TrimmingCurve curve;
  for (const sail::Curve& side :
       {border.foot, border.leech, border.top.reversed(), border.luff.reversed()}) {
    const double least = 1e-7 * side.length() + 1e-300;
    curve.corners.push_back(static_cast<Index>(points.size()));
    for (Index i = 0; i + 1 < side.points().cols(); ++i) {
      const Vector2d p(side.points()(0, i), side.points()(2, i));
      if (points.empty() || (p - points.back()).norm() > least) points.push_back(p);
    }
  }
  std::vector<Vector2d> corners;
  for (const Index corner : curve.corners)
    corners.push_back(points[std::min(static_cast<std::size_t>(corner), points.size() - 1)]);
  while (points.size() > 4 && cut_crossing(points)) {
  }
  const auto n = static_cast<Index>(points.size());
  curve.loop.resize(2, n);
  for (Index i = 0; i < n; ++i) curve.loop.col(i) = points[static_cast<std::size_t>(i)];
  for (std::size_t k = 0; k < corners.size(); ++k)
    (curve.loop.colwise() - corners[k]).colwise().squaredNorm().minCoeff(&curve.corners[k]);
  return curve;
}

}  // namespace velum::meshing
