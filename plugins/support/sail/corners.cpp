// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "sail/corners.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace velum::sail {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// A closed polygon of which any stretch, given by positions that may run beyond its ends, is fitted
// by a straight line in constant time.
class Ring {
 public:
  explicit Ring(Matrix3Xd points) : points_(std::move(points)), n_(points_.cols()) {
    const Vector3d centre = points_.rowwise().mean();
    sums_.resize(static_cast<std::size_t>(3 * n_ + 1));
    arc_.resize(3 * n_ + 1);
    arc_[0] = 0.0;
    for (Index k = 0; k < 3 * n_; ++k) {
      const Vector3d p = at(k) - centre;
      const double before = (at(k) - at(k + n_ - 1)).norm();
      const double after = (at(k + 1) - at(k)).norm();
      Sums next = sums_[static_cast<std::size_t>(k)];
      const double weight = 0.5 * (before + after);
      next.weight += weight;
      next.first += weight * p;
      next.second += weight * p * p.transpose();
      sums_[static_cast<std::size_t>(k + 1)] = next;
      arc_[k + 1] = arc_[k] + after;
    }
  }
  [[nodiscard]] Index size() const { return n_; }
  [[nodiscard]] double length() const { return arc_[n_]; }
  [[nodiscard]] Vector3d at(Index k) const { return points_.col(k % n_); }
  // Position [0, 3n] that lies `distance` before or after k.
  [[nodiscard]] Index step(Index k, double distance) const {
    const auto found = std::lower_bound(arc_.begin(), arc_.end(), arc_[k] + distance);
    return std::clamp<Index>(found - arc_.begin(), 0, 3 * n_ - 1);
  }
  // Weighted squares off the best line through the points k ... l.
  [[nodiscard]] double off_line(Index k, Index l) const {
    const Sums& a = sums_[static_cast<std::size_t>(k)];
    const Sums& b = sums_[static_cast<std::size_t>(l + 1)];
    const double weight = b.weight - a.weight;
    if (!(weight > 0.0)) return 0.0;
    const Vector3d mean = (b.first - a.first) / weight;
    const Matrix3d spread = b.second - a.second - weight * mean * mean.transpose();
    Eigen::SelfAdjointEigenSolver<Matrix3d> eigen;
    eigen.computeDirect(spread, Eigen::EigenvaluesOnly);
    return std::max(0.0, spread.trace() - eigen.eigenvalues().maxCoeff());
  }
  // Turning between the chords of length `scale` before and after k [rad].
  [[nodiscard]] double turning(Index k, double scale) const {
    const Vector3d in = at(k) - at(step(k, -scale));
    const Vector3d out = at(step(k, scale)) - at(k);
    return std::acos(std::clamp(in.normalized().dot(out.normalized()), -1.0, 1.0));
  }

 private:
  struct Sums {
    double weight = 0.0;
    Vector3d first = Vector3d::Zero();
    Matrix3d second = Matrix3d::Zero();
  };
  Matrix3Xd points_;
  Index n_;
  std::vector<Sums> sums_;
  VectorXd arc_;
};

// The position within `reach` of `around` (in the ring's middle copy) at which two lines of length
// `scale` explain the border so much better than one.
Index corner_at_scale(const Ring& ring, Index around, double reach, double scale) {
  Index best = around;
  double most = 0.0;
  for (Index k = ring.step(around, -reach); k <= ring.step(around, reach); ++k) {
    const Index from = ring.step(k, -scale);
    const Index to = ring.step(k, scale);
    const double gain = ring.off_line(from, to) - ring.off_line(from, k) - ring.off_line(k, to);
    if (gain <= most) continue;
    most = gain;
    best = k;
  }
  return best;
}

// Long lines find the corner among the zigzag of the border; its place is where two lines leave
// least of a shorter stretch about it, since long ones lie off a curved side.
Index corner_near(const Ring& ring, Index around, double reach, double scale) {
  Index best = corner_at_scale(ring, around, reach, scale);
  for (int round = 0; round < 3; ++round) {
    const Index from = ring.step(best, -0.5 * scale);
    const Index to = ring.step(best, 0.5 * scale);
    double least = std::numeric_limits<double>::infinity();
    for (Index k = ring.step(best, -0.35 * scale); k <= ring.step(best, 0.35 * scale); ++k) {
      const double off = ring.off_line(from, k) + ring.off_line(k, to);
      if (off >= least) continue;
      least = off;
      around = k;
    }
    if (around == best) break;
    best = around;
  }
  return best;
}

struct Top {
  Index head;
  Index peak;
};

// The two positions about the apex that leave the least off three lines: luff, top edge, leech.
Top top_near(const Ring& ring, Index apex, double reach, double scale) {
  const Index first = ring.step(apex, -reach);
  const Index last = ring.step(apex, reach);
  const Index begin = ring.step(first, -scale);
  const Index end = ring.step(last, scale);
  Top best{apex, apex};
  double least = std::numeric_limits<double>::infinity();
  for (Index i = first; i <= apex; ++i) {
    const double luff = ring.off_line(begin, i);
    if (luff >= least) continue;
    for (Index j = apex; j <= last; ++j) {
      const double off = luff + ring.off_line(i, j) + ring.off_line(j, end);
      if (off >= least) continue;
      least = off;
      best = {i, j};
    }
  }
  return best;
}

// The sharpest turn from position k to l, if it is one of more than 35 degrees.
Index sharp_turn(const Ring& ring, Index k, Index l, double scale, Index otherwise) {
  Index best = otherwise;
  double most = 35.0 * std::numbers::pi / 180.0;
  for (; k < l; ++k) {
    const double turn = ring.turning(k, scale);
    if (turn <= most) continue;
    most = turn;
    best = k;
  }
  return best;
}

template <class Score>
Index best_of(const Matrix3Xd& points, const Score& score) {
  Index best = 0;
  for (Index i = 1; i < points.cols(); ++i)
    if (score(points.col(i)) > score(points.col(best))) best = i;
  return best;
}

// Is `b` met before `c` when going forward from `a`?
bool in_order(Index a, Index b, Index c, Index n) {
  return (b - a + n) % n < (c - a + n) % n;
}

}  // namespace

Outline find_corners(const Matrix3Xd& polygon, double spacing) {
  const Index n = polygon.cols();
  Matrix3Xd points = polygon;
  const Vector3d extent = points.rowwise().maxCoeff() - points.rowwise().minCoeff();
  const double wide = std::max(extent.x(), 1e-9);
  const double high = std::max(extent.z(), 1e-9);
  const auto low_fore = [&](const Vector3d& p) { return -p.x() / wide - p.z() / high; };
  const auto low_aft = [&](const Vector3d& p) { return p.x() / wide - p.z() / high; };
  const auto up = [](const Vector3d& p) { return p.z(); };
  const bool backwards =
      !in_order(best_of(points, low_fore), best_of(points, up), best_of(points, low_aft), n);
  if (backwards) points.rowwise().reverseInPlace();

  const Ring ring(points);
  const double scale = std::clamp(12.0 * spacing, 0.03 * ring.length(), 0.08 * ring.length());
  const double reach = 0.05 * ring.length();
  const Index tack = corner_near(ring, n + best_of(points, low_fore), reach, scale);
  const auto after_tack = [&](Index k) { return tack + ((k - tack) % n + n) % n; };
  const Index clew = after_tack(corner_near(ring, n + best_of(points, low_aft), reach, scale));
  const double top_reach = std::max(0.02 * ring.length(), 4.0 * spacing);
  Top top = top_near(ring, n + best_of(points, up), top_reach, scale);
  top.head = after_tack(top.head);
  top.peak = std::max(top.head, after_tack(top.peak));
  const double apart = 2.0 * scale;
  top.head = sharp_turn(ring, ring.step(tack, apart), ring.step(top.head, -apart), scale, top.head);
  top.peak = sharp_turn(ring, ring.step(top.peak, apart), ring.step(clew, -apart), scale, top.peak);
  if (!(tack < top.head && top.peak < clew))
    throw Error(Fault::stage, "no tack, head and clew in this order around the border were found")
        .hint("check 'up' and 'bow', and that the mesh is one sail");

  Outline outline;
  outline.points.resize(3, n);
  outline.arc.resize(n);
  double arc = 0.0;
  for (Index i = 0; i < n; ++i) {
    outline.points.col(i) = ring.at(tack + i);
    const Index place = (tack + i) % n;
    outline.places.push_back(static_cast<std::int32_t>(backwards ? n - 1 - place : place));
    outline.arc[i] = arc;
    arc += (ring.at(tack + i + 1) - ring.at(tack + i)).norm();
  }
  outline.length = arc;
  outline.spacing = spacing;
  outline.head = top.head - tack;
  outline.peak = top.peak - tack;
  outline.clew = clew - tack;
  outline.has_top =
      outline.arc[outline.peak] - outline.arc[outline.head] > std::max(8.0 * spacing, 0.015 * arc);
  return outline;
}

}  // namespace velum::sail
