// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "sail/sample.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace velum::sail {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr Index kAcross = 160;
constexpr Index kAlong = 240;

// The values of the degree + 1 basis functions that are not zero at x, and the first one's number
// (Cox and de Boor).
struct Local {
  Index first;
  VectorXd values;
};
Local basis_at(const VectorXd& knots, int degree, double x) {
  const Index count = knots.size() - degree - 1;
  Index span = degree;
  while (span + 1 < count && knots[span + 1] <= x) ++span;
  VectorXd values = VectorXd::Zero(degree + 1);
  values[0] = 1.0;
  for (Index d = 1; d <= degree; ++d) {
    double carry = 0.0;
    for (Index j = 0; j < d; ++j) {
      const double right = knots[span + 1 + j];
      const double left = knots[span + 1 + j - d];
      const double share = right > left ? values[j] / (right - left) : 0.0;
      values[j] = carry + (right - x) * share;
      carry = (x - left) * share;
    }
    values[d] = carry;
  }
  return {span - degree, std::move(values)};
}

class Patch {
 public:
  explicit Patch(const Surface& surface)
      : surface_(surface),
        count_u_(surface.knots_u.size() - surface.degree_u - 1),
        count_v_(surface.knots_v.size() - surface.degree_v - 1) {
    const bool fits =
        surface.degree_u >= 1 && surface.degree_v >= 1 && count_u_ > surface.degree_u &&
        count_v_ > surface.degree_v && surface.control.cols() == count_u_ * count_v_ &&
        (surface.weights.size() == 0 || surface.weights.size() == surface.control.cols());
    if (!fits)
      throw Error(Fault::stage,
                  "the surface's knots, control points and weights do not fit "
                  "together");
  }
  [[nodiscard]] Vector2d low() const {
    return {surface_.knots_u[surface_.degree_u], surface_.knots_v[surface_.degree_v]};
  }
  [[nodiscard]] Vector2d high() const {
    return {surface_.knots_u[count_u_], surface_.knots_v[count_v_]};
  }
  [[nodiscard]] Vector3d at(const Vector2d& uv) const {
    const Local u = basis_at(surface_.knots_u, surface_.degree_u, uv.x());
    const Local v = basis_at(surface_.knots_v, surface_.degree_v, uv.y());
    Vector3d sum = Vector3d::Zero();
    double total = 0.0;
    for (Index i = 0; i < u.values.size(); ++i)
      for (Index j = 0; j < v.values.size(); ++j) {
        const Index k = (u.first + i) * count_v_ + v.first + j;
        const double weight = surface_.weights.size() == 0 ? 1.0 : surface_.weights[k];
        const double share = u.values[i] * v.values[j] * weight;
        sum += share * surface_.control.col(k);
        total += share;
      }
    return sum / total;
  }

 private:
  const Surface& surface_;
  Index count_u_;
  Index count_v_;
};

bool inside(const Eigen::Matrix2Xd& loop, const Vector2d& p) {
  bool in = false;
  for (Index i = 0, j = loop.cols() - 1; i < loop.cols(); j = i++) {
    const Vector2d a = loop.col(i);
    const Vector2d b = loop.col(j);
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
      in = !in;
  }
  return in;
}

Vector2d nearest_on(const Eigen::Matrix2Xd& loop, const Vector2d& p) {
  Vector2d best = p;
  double least = std::numeric_limits<double>::infinity();
  for (Index i = 0, j = loop.cols() - 1; i < loop.cols(); j = i++) {
    const Vector2d a = loop.col(j);
    const Vector2d edge = loop.col(i) - a;
    const double square = edge.squaredNorm();
    const double s = square > 0.0 ? std::clamp((p - a).dot(edge) / square, 0.0, 1.0) : 0.0;
    const Vector2d at = a + s * edge;
    if ((at - p).squaredNorm() >= least) continue;
    least = (at - p).squaredNorm();
    best = at;
  }
  return best;
}

}  // namespace

Mesh sample(const Surface& surface) {
  const Patch patch(surface);
  const Index row = kAcross + 1;
  Eigen::Matrix2Xd places(2, row * (kAlong + 1));
  std::vector<bool> in(static_cast<std::size_t>(places.cols()), true);
  for (Index j = 0; j <= kAlong; ++j)
    for (Index i = 0; i <= kAcross; ++i) {
      const Vector2d share(static_cast<double>(i) / static_cast<double>(kAcross),
                           static_cast<double>(j) / static_cast<double>(kAlong));
      const Index k = j * row + i;
      places.col(k) = patch.low() + (patch.high() - patch.low()).cwiseProduct(share);
      if (!surface.trimming.empty())
        in[static_cast<std::size_t>(k)] = inside(surface.trimming.front(), places.col(k));
    }
  std::vector<std::int32_t> vertex(static_cast<std::size_t>(places.cols()), -1);
  std::vector<std::array<std::int32_t, 3>> triangles;
  Points points(3, places.cols());
  Index used = 0;
  const auto take = [&](Index k) {
    std::int32_t& number = vertex[static_cast<std::size_t>(k)];
    if (number >= 0) return number;
    const Vector2d uv = in[static_cast<std::size_t>(k)]
                            ? Vector2d(places.col(k))
                            : nearest_on(surface.trimming.front(), places.col(k));
    points.col(used) = patch.at(uv).cast<float>();
    number = static_cast<std::int32_t>(used++);
    return number;
  };
  const auto add = [&](Index a, Index b, Index c) {
    for (const Index k : {a, b, c})
      if (in[static_cast<std::size_t>(k)]) {
        triangles.push_back({take(a), take(b), take(c)});
        return;
      }
  };
  for (Index j = 0; j < kAlong; ++j)
    for (Index i = 0; i < kAcross; ++i) {
      const Index a = j * row + i;
      add(a, a + 1, a + row + 1);
      add(a, a + row + 1, a + row);
    }
  Triangles out(3, static_cast<Index>(triangles.size()));
  for (Index i = 0; i < out.cols(); ++i)
    for (Index k = 0; k < 3; ++k)
      out(k, i) = triangles[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
  Cloud vertices(Points(points.leftCols(used)), surface.origin);
  return {vertices.with_sensors(surface.sensors), std::move(out)};
}

}  // namespace velum::sail
