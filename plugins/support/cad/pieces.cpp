// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "cad/pieces.hpp"

#include <algorithm>
#include <cmath>

namespace velum::cad {
namespace {

constexpr double kCornerCosine = 0.866;  // 30°
constexpr double kPoleLength = 1e-9;     // [m]

double signed_area(const Eigen::Matrix2Xd& loop) {
  double area = 0.0;
  for (Index i = 0; i < loop.cols(); ++i) {
    const Index next = (i + 1) % loop.cols();
    area += loop(0, i) * loop(1, next) - loop(0, next) * loop(1, i);
  }
  return area / 2.0;
}

Eigen::Matrix3Xd on_surface(const bspline::Patch& patch, const Eigen::Matrix2Xd& loop) {
  Eigen::Matrix3Xd places(3, loop.cols());
  for (Index i = 0; i < loop.cols(); ++i) places.col(i) = patch.at(loop.col(i));
  return places;
}

std::vector<Index> corners_of(const Eigen::Matrix3Xd& places) {
  const Index n = places.cols();
  std::vector<Index> corners;
  for (Index i = 0; i < n; ++i) {
    const Eigen::Vector3d before = places.col(i) - places.col((i + n - 1) % n);
    const Eigen::Vector3d after = places.col((i + 1) % n) - places.col(i);
    const bool at_pole = before.norm() < kPoleLength || after.norm() < kPoleLength;
    if (at_pole || before.dot(after) < kCornerCosine * before.norm() * after.norm())
      corners.push_back(i);
  }
  return corners;
}

}  // namespace

Eigen::Matrix2Xd clean_loop(const bspline::Patch& patch, const Eigen::Matrix2Xd& loop,
                            bool counter_clockwise) {
  const Eigen::Vector2d low = patch.low();
  const Eigen::Vector2d high = patch.high();
  const Eigen::Array2d slack = 1e-9 * (high - low).array();
  Eigen::Matrix2Xd kept(2, loop.cols());
  Index count = 0;
  for (Index i = 0; i < loop.cols(); ++i) {
    const Eigen::Vector2d uv = loop.col(i);
    if (!((uv.array() >= low.array() - slack).all() && (uv.array() <= high.array() + slack).all()))
      throw Error(Fault::stage, "a trimming loop leaves the surface's range of (u, v)");
    const bool again = count > 0 && (kept.col(count - 1) - uv).norm() < slack.minCoeff();
    if (!again) kept.col(count++) = uv.cwiseMax(low).cwiseMin(high);
  }
  while (count > 1 && (kept.col(count - 1) - kept.col(0)).norm() < slack.minCoeff()) --count;
  kept.conservativeResize(2, count);
  const double area = signed_area(kept);
  if (count < 3 || area == 0.0)
    throw Error(Fault::stage,
                "a trimming loop encloses nothing: expected three points or more "
                "that are not on a line");
  if ((area > 0.0) == counter_clockwise) return kept;
  return kept.rowwise().reverse();
}

std::vector<Piece> pieces_of(const bspline::Patch& patch, const Eigen::Matrix2Xd& loop) {
  const Index n = loop.cols();
  const Eigen::Matrix3Xd places = on_surface(patch, loop);
  std::vector<Index> corners = corners_of(places);
  if (corners.empty()) corners.push_back(0);
  if (corners.size() == 1) {
    corners.push_back((corners.front() + n / 2) % n);
    std::sort(corners.begin(), corners.end());
  }
  std::vector<Piece> pieces;
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const Index begin = corners[c];
    const Index end = corners[(c + 1) % corners.size()] + (c + 1 == corners.size() ? n : 0);
    Piece& piece = pieces.emplace_back();
    piece.uv.resize(2, end - begin + 1);
    for (Index i = begin; i <= end; ++i) piece.uv.col(i - begin) = loop.col(i % n);
    piece.pole = end == begin + 1 && (places.col(end % n) - places.col(begin)).norm() < kPoleLength;
  }
  return pieces;
}

}  // namespace velum::cad
