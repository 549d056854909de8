// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "report/surface_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace velum::report {
namespace {

using Eigen::Matrix2Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kSteps = 96;  // of the grid, in each direction
constexpr int kHalvings = 7;

/// Values of all basis functions at x, by their recursion over the degree (de Boor, 1972).
VectorXd basis(const VectorXd& knots, int degree, double x) {
  const Index spans = knots.size() - 1;
  VectorXd values = VectorXd::Zero(spans);
  Index span = degree;
  while (span + 1 < spans - degree && x >= knots[span + 1]) ++span;
  values[span] = 1.0;
  for (int p = 1; p <= degree; ++p)
    for (Index i = 0; i < spans - p; ++i) {
      const double left = knots[i + p] - knots[i];
      const double right = knots[i + p + 1] - knots[i + 1];
      values[i] = (left > 0.0 ? (x - knots[i]) / left * values[i] : 0.0) +
                  (right > 0.0 ? (knots[i + p + 1] - x) / right * values[i + 1] : 0.0);
    }
  return values.head(spans - degree);
}

bool sound(const VectorXd& knots, int degree) {
  return degree >= 1 && knots.size() >= Index{2} * (degree + 1) && knots.allFinite() &&
         std::is_sorted(knots.begin(), knots.end()) &&
         knots[degree] < knots[knots.size() - degree - 1];
}

class Sampler {
 public:
  explicit Sampler(const Surface& surface) : surface_(surface) {
    const VectorXd& u = surface.knots_u;
    const VectorXd& v = surface.knots_v;
    low_ = {u[surface.degree_u], v[surface.degree_v]};
    high_ = {u[u.size() - surface.degree_u - 1], v[v.size() - surface.degree_v - 1]};
  }

  Mesh mesh() {
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j) {
        const std::array<int, 4> corner = {number(i, j), number(i + 1, j), number(i + 1, j + 1),
                                           number(i, j + 1)};
        add({corner[0], corner[1], corner[2]});
        add({corner[0], corner[2], corner[3]});
      }
    Points points(3, static_cast<Index>(places_.size()));
    for (Index i = 0; i < points.cols(); ++i)
      points.col(i) = at(places_[static_cast<std::size_t>(i)]).cast<float>();
    Triangles triangles(3, static_cast<Index>(triangles_.size()));
    for (Index t = 0; t < triangles.cols(); ++t)
      for (int k = 0; k < 3; ++k)
        triangles(k, t) = triangles_[static_cast<std::size_t>(t)][static_cast<std::size_t>(k)];
    if (!points.allFinite()) return {};
    return Mesh(Cloud(std::move(points), surface_.origin).with_sensors(surface_.sensors),
                std::move(triangles));
  }

 private:
  static int number(int i, int j) { return i * (kSteps + 1) + j; }

  [[nodiscard]] Vector2d place(int number) const {
    const int row = number / (kSteps + 1);
    const int column = number % (kSteps + 1);
    const Vector2d share(static_cast<double>(row) / kSteps, static_cast<double>(column) / kSteps);
    return low_ + share.cwiseProduct(high_ - low_);
  }

  /// Even-odd rule over all loops.
  [[nodiscard]] bool inside(const Vector2d& uv) const {
    bool in = surface_.trimming.empty();
    for (const Matrix2Xd& loop : surface_.trimming)
      for (Index i = 0, last = loop.cols() - 1; i < loop.cols(); last = i++) {
        const Vector2d a = loop.col(last);
        const Vector2d b = loop.col(i);
        if ((a.y() > uv.y()) == (b.y() > uv.y())) continue;
        if (uv.x() < a.x() + (uv.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) in = !in;
      }
    return in;
  }

  [[nodiscard]] bool kept(int number) {
    const auto [found, fresh] = inside_.emplace(number, false);
    if (fresh) found->second = inside(place(number));
    return found->second;
  }

  /// The vertex at a corner of the grid, or where the border cuts the edge from one to another.
  std::int32_t vertex(int corner) { return vertex(corner, corner); }
  std::int32_t vertex(int in, int out) {
    const auto next = static_cast<std::int32_t>(places_.size());
    const auto [found, fresh] = vertices_.emplace(std::pair(in, out), next);
    if (fresh) places_.push_back(in == out ? place(in) : crossing(place(in), place(out)));
    return found->second;
  }

  [[nodiscard]] Vector2d crossing(Vector2d in, Vector2d out) const {
    for (int i = 0; i < kHalvings; ++i) {
      const Vector2d middle = 0.5 * (in + out);
      (inside(middle) ? in : out) = middle;
    }
    return in;
  }

  /// What lies inside of a triangle of the grid: all of it, a corner, or all but a corner.
  void add(std::array<int, 3> corner) {
    std::array<bool, 3> in{};
    for (std::size_t k = 0; k < 3; ++k) in[k] = kept(corner[k]);
    const auto count = std::ranges::count(in, true);
    if (count == 0) return;
    if (count == 3) {
      triangles_.push_back({vertex(corner[0]), vertex(corner[1]), vertex(corner[2])});
      return;
    }
    // The corner that is not like the others first.
    while (in[0] != (count == 1)) {
      std::rotate(in.begin(), in.begin() + 1, in.end());
      std::rotate(corner.begin(), corner.begin() + 1, corner.end());
    }
    const auto [a, b, c] = corner;
    if (count == 1) {
      triangles_.push_back({vertex(a), vertex(a, b), vertex(a, c)});
    } else {
      triangles_.push_back({vertex(b, a), vertex(b), vertex(c)});
      triangles_.push_back({vertex(b, a), vertex(c), vertex(c, a)});
    }
  }

  [[nodiscard]] Vector3d at(const Vector2d& uv) const {
    const VectorXd u = basis(surface_.knots_u, surface_.degree_u, uv.x());
    const VectorXd v = basis(surface_.knots_v, surface_.degree_v, uv.y());
    Vector3d sum = Vector3d::Zero();
    double total = 0.0;
    for (Index i = 0; i < u.size(); ++i) {
      if (u[i] == 0.0) continue;
      for (Index j = 0; j < v.size(); ++j) {
        const Index k = i * v.size() + j;
        const double weight = surface_.weights.size() == 0 ? 1.0 : surface_.weights[k];
        sum += u[i] * v[j] * weight * surface_.control.col(k);
        total += u[i] * v[j] * weight;
      }
    }
    return sum / total;
  }

  const Surface& surface_;
  Vector2d low_;
  Vector2d high_;
  std::vector<Vector2d> places_;
  std::vector<std::array<std::int32_t, 3>> triangles_;
  std::map<int, bool> inside_;
  std::map<std::pair<int, int>, std::int32_t> vertices_;
};

}  // namespace

Mesh sampled(const Surface& surface) {
  if (!sound(surface.knots_u, surface.degree_u) || !sound(surface.knots_v, surface.degree_v))
    return {};
  const Index count_u = surface.knots_u.size() - surface.degree_u - 1;
  const Index count_v = surface.knots_v.size() - surface.degree_v - 1;
  if (surface.control.cols() != count_u * count_v) return {};
  if (surface.weights.size() != 0 && surface.weights.size() != surface.control.cols()) return {};
  return Sampler(surface).mesh();
}

}  // namespace velum::report
