// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "bspline/evaluate.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace velum::bspline {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Number of the span that holds x: knots[span] <= x < knots[span + 1], the last one at the end.
Index span_of(const VectorXd& knots, int degree, double x) {
  const Index count = count_of(knots, degree);
  if (x >= knots[count]) {
    Index last = count - 1;
    while (last > degree && knots[last] >= knots[count]) --last;
    return last;
  }
  const auto* begin = knots.data() + degree;
  const auto* end = knots.data() + count;
  return std::max<Index>(std::upper_bound(begin, end, x) - knots.data() - 1, degree);
}

bool ascending(const VectorXd& knots, int degree) {
  for (Index i = 0; i + 1 < knots.size(); ++i)
    if (!(knots[i] <= knots[i + 1])) return false;
  return knots[degree] < knots[count_of(knots, degree)];
}

bool sound(const VectorXd& knots, int degree) {
  return degree >= 1 && degree <= kMostDegree && count_of(knots, degree) > degree &&
         knots.allFinite() && ascending(knots, degree);
}

[[noreturn]] void refuse(const std::string& what) {
  throw Error(Fault::stage, "the surface is not sound: " + what);
}

using Triangle = std::array<std::array<double, kMostDegree + 1>, kMostDegree + 1>;

// Upper triangle: basis functions of all degrees over the span; lower: differences of knots.
void fill(Triangle& ndu, const VectorXd& knots, int degree, Index span, double x) {
  std::array<double, kMostDegree + 1> left{};
  std::array<double, kMostDegree + 1> right{};
  ndu[0][0] = 1.0;
  for (int j = 1; j <= degree; ++j) {
    const auto sj = static_cast<std::size_t>(j);
    left[sj] = x - knots[span + 1 - j];
    right[sj] = knots[span + j] - x;
    double carry = 0.0;
    for (std::size_t r = 0; r < sj; ++r) {
      ndu[sj][r] = right[r + 1] + left[sj - r];
      const double share = ndu[sj][r] != 0.0 ? ndu[r][sj - 1] / ndu[sj][r] : 0.0;
      ndu[r][sj] = carry + right[r + 1] * share;
      carry = left[sj - r] * share;
    }
    ndu[sj][sj] = carry;
  }
}

// d-th derivatives from the triangle (A2.3), without the factor degree! / (degree - d)!.
void differentiate(const Triangle& ndu, int degree, int derivatives, Eigen::MatrixXd& values) {
  const auto at = [&](int i, int j) {
    return ndu[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  };
  const auto over = [](double a, double b) { return b != 0.0 ? a / b : 0.0; };
  for (int r = 0; r <= degree; ++r) {
    std::array<std::array<double, kMostDegree + 1>, 2> a{};
    std::size_t now = 0;
    a[0][0] = 1.0;
    for (int k = 1; k <= derivatives; ++k) {
      const auto& old = a[now];
      auto& next = a[1 - now];
      const int rk = r - k;
      const int pk = degree - k;
      double d = 0.0;
      next.fill(0.0);
      if (r >= k) {
        next[0] = over(old[0], at(pk + 1, rk));
        d = next[0] * at(rk, pk);
      }
      const int first = rk >= -1 ? 1 : -rk;
      const int last = r - 1 <= pk ? k - 1 : degree - r;
      for (int j = first; j <= last; ++j) {
        const auto sj = static_cast<std::size_t>(j);
        next[sj] = over(old[sj] - old[sj - 1], at(pk + 1, rk + j));
        d += next[sj] * at(rk + j, pk);
      }
      if (r <= pk) {
        const auto sk = static_cast<std::size_t>(k);
        next[sk] = over(-old[sk - 1], at(pk + 1, r));
        d += next[sk] * at(r, pk);
      }
      values(k, r) = d;
      now = 1 - now;
    }
  }
}

}  // namespace

Basis basis(const VectorXd& knots, int degree, double x, int derivatives) {
  const Index span = span_of(knots, degree, x);
  Triangle ndu;
  fill(ndu, knots, degree, span, x);
  Basis found;
  found.first = span - degree;
  found.values = Eigen::MatrixXd::Zero(derivatives + 1, degree + 1);
  for (int j = 0; j <= degree; ++j)
    found.values(0, j) = ndu[static_cast<std::size_t>(j)][static_cast<std::size_t>(degree)];
  const int most = std::min(derivatives, degree);
  differentiate(ndu, degree, most, found.values);
  double factor = degree;
  for (int k = 1; k <= most; ++k) {
    found.values.row(k) *= factor;
    factor *= degree - k;
  }
  return found;
}

VectorXd uniform_knots(int degree, Index spans, double low, double high) {
  VectorXd knots(spans + 1 + 2 * degree);
  for (Index i = 0; i < knots.size(); ++i) {
    const auto at = static_cast<double>(std::clamp<Index>(i - degree, 0, spans));
    knots[i] = low + (high - low) * (at / static_cast<double>(spans));
  }
  return knots;
}

VectorXd greville(const VectorXd& knots, int degree) {
  VectorXd means(count_of(knots, degree));
  for (Index i = 0; i < means.size(); ++i) means[i] = knots.segment(i + 1, degree).mean();
  return means;
}

Vector3d Derivatives::normal() const {
  const Vector3d n = du.cross(dv);
  const double length = n.norm();
  return length > 1e-300 ? Vector3d(n / length) : Vector3d(Vector3d::Zero());
}

Patch::Patch(const Surface& surface)
    : surface_(surface),
      count_u_(count_of(surface.knots_u, surface.degree_u)),
      count_v_(count_of(surface.knots_v, surface.degree_v)) {
  if (!sound(surface.knots_u, surface.degree_u) || !sound(surface.knots_v, surface.degree_v))
    refuse("degrees are 1 to 15, and knots ascend, at least two more than twice the degree");
  if (surface.control.cols() != count_u_ * count_v_ || !surface.control.allFinite())
    refuse(std::to_string(surface.control.cols()) + " control points where " +
           std::to_string(count_u_) + " by " + std::to_string(count_v_) + " finite ones belong");
  const bool weighted = surface.weights.size() > 0;
  if (weighted && (surface.weights.size() != surface.control.cols() ||
                   !(surface.weights.minCoeff() > 0.0) || !surface.weights.allFinite()))
    refuse("weights are positive, one a control point");
  for (const Eigen::Matrix2Xd& loop : surface.trimming)
    if (loop.cols() < 3 || !loop.allFinite())
      refuse("a trimming loop has at least three finite points");
}

Vector2d Patch::low() const {
  return {surface_.knots_u[surface_.degree_u], surface_.knots_v[surface_.degree_v]};
}

Vector2d Patch::high() const {
  return {surface_.knots_u[count_u_], surface_.knots_v[count_v_]};
}

Vector3d Patch::at(const Vector2d& uv) const {
  const Basis u = basis(surface_.knots_u, surface_.degree_u, uv.x());
  const Basis v = basis(surface_.knots_v, surface_.degree_v, uv.y());
  Vector3d sum = Vector3d::Zero();
  double total = 0.0;
  for (Index i = 0; i < u.values.cols(); ++i)
    for (Index j = 0; j < v.values.cols(); ++j) {
      const Index k = (u.first + i) * count_v_ + v.first + j;
      const double share = u.values(0, i) * v.values(0, j) * weight(k);
      sum += share * surface_.control.col(k);
      total += share;
    }
  return sum / total;
}

Derivatives Patch::derivatives(const Vector2d& uv) const {
  const Basis u = basis(surface_.knots_u, surface_.degree_u, uv.x(), 2);
  const Basis v = basis(surface_.knots_v, surface_.degree_v, uv.y(), 2);
  // Homogeneous: x, y, z times weight, and weight.
  std::array<std::array<Eigen::Vector4d, 3>, 3> h;
  for (auto& row : h) row.fill(Eigen::Vector4d::Zero());
  for (Index i = 0; i < u.values.cols(); ++i)
    for (Index j = 0; j < v.values.cols(); ++j) {
      const Index k = (u.first + i) * count_v_ + v.first + j;
      Eigen::Vector4d p;
      p << weight(k) * surface_.control.col(k), weight(k);
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; a + b < 3; ++b)
          h[a][b] += u.values(static_cast<Index>(a), i) * v.values(static_cast<Index>(b), j) * p;
    }
  const double w = h[0][0][3];
  const auto part = [](const Eigen::Vector4d& p) -> Vector3d { return p.head<3>(); };
  Derivatives d;
  d.point = part(h[0][0]) / w;
  d.du = (part(h[1][0]) - h[1][0][3] * d.point) / w;
  d.dv = (part(h[0][1]) - h[0][1][3] * d.point) / w;
  d.duu = (part(h[2][0]) - 2.0 * h[1][0][3] * d.du - h[2][0][3] * d.point) / w;
  d.dvv = (part(h[0][2]) - 2.0 * h[0][1][3] * d.dv - h[0][2][3] * d.point) / w;
  d.duv = (part(h[1][1]) - h[1][0][3] * d.dv - h[0][1][3] * d.du - h[1][1][3] * d.point) / w;
  return d;
}

Vector2d Patch::project(const Vector3d& p, const Vector2d& start) const {
  const Vector2d from = low();
  const Vector2d to = high();
  Vector2d at = start.cwiseMax(from).cwiseMin(to);
  Derivatives d = derivatives(at);
  double best = (d.point - p).squaredNorm();
  for (int round = 0; round < 20; ++round) {
    const Vector3d gap = d.point - p;
    // Gauss and Newton's matrix; the second derivatives only where they keep it positive.
    Eigen::Matrix2d m;
    m << d.du.squaredNorm(), d.du.dot(d.dv), d.du.dot(d.dv), d.dv.squaredNorm();
    Eigen::Matrix2d full = m;
    full += (Eigen::Matrix2d() << gap.dot(d.duu), gap.dot(d.duv), gap.dot(d.duv), gap.dot(d.dvv))
                .finished();
    if (full(0, 0) > 0.0 && full.determinant() > 0.1 * m.determinant()) m = full;
    Vector2d slope(gap.dot(d.du), gap.dot(d.dv));
    // A coordinate that wants to leave the range stays at its end.
    for (Index i = 0; i < 2; ++i) {
      const bool held = (at[i] <= from[i] && slope[i] > 0.0) || (at[i] >= to[i] && slope[i] < 0.0);
      if (!held) continue;
      slope[i] = 0.0;
      m(0, 1) = m(1, 0) = 0.0;
    }
    m.diagonal().array() += 1e-12 * m.trace() + 1e-300;
    Vector2d step = -m.inverse() * slope;
    double cut = 1.0;
    Vector2d next = at;
    Derivatives there = d;
    for (; cut > 1e-3; cut *= 0.5) {
      next = (at + cut * step).cwiseMax(from).cwiseMin(to);
      there = derivatives(next);
      if ((there.point - p).squaredNorm() < best) break;
    }
    if (cut <= 1e-3) break;
    const double moved = ((next - at).array() / (to - from).array()).matrix().norm();
    at = next;
    d = there;
    best = (d.point - p).squaredNorm();
    if (moved < 1e-12) break;
  }
  return at;
}

bool inside(const std::vector<Eigen::Matrix2Xd>& loops, const Vector2d& uv) {
  if (loops.empty()) return true;
  bool in = false;
  for (const Eigen::Matrix2Xd& loop : loops)
    for (Index i = 0, j = loop.cols() - 1; i < loop.cols(); j = i++) {
      const Vector2d a = loop.col(i);
      const Vector2d b = loop.col(j);
      if ((a.y() > uv.y()) != (b.y() > uv.y()) &&
          uv.x() < (b.x() - a.x()) * (uv.y() - a.y()) / (b.y() - a.y()) + a.x())
        in = !in;
    }
  return in;
}

}  // namespace velum::bspline
