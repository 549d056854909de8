// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <mutex>
#include <numbers>

#include "bspline/evaluate.hpp"
#include "bspline/fit.hpp"
#include "bspline/refine.hpp"
#include "bspline/tessellate.hpp"
#include "mesh/topology.hpp"

using Eigen::Matrix2Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using velum::Index;
using velum::Surface;
using namespace velum::bspline;

namespace {

class Alone final : public velum::Context {
 public:
  [[nodiscard]] int threads() const override { return 1; }
  [[nodiscard]] velum::Random random() const override { return velum::Random(1); }
  void progress(double) override {}
  [[nodiscard]] bool cancelled() const noexcept override { return false; }
  void warn(const std::string&) override {}
  void info(const std::string&) override {}
  void measure(const std::string&, double, const std::string&, velum::Better) override {}
  void run_chunks(Index chunks, const std::function<void(Index)>& body) override {
    for (Index i = 0; i < chunks; ++i) body(i);
  }
};

// A cubic by quadratic surface with uneven knots and no symmetry.
Surface wavy() {
  Surface s;
  s.degree_u = 3;
  s.degree_v = 2;
  s.knots_u.resize(10);
  s.knots_u << 0, 0, 0, 0, 0.3, 0.45, 1, 1, 1, 1;
  s.knots_v.resize(8);
  s.knots_v << -1, -1, -1, 0.5, 1.2, 2, 2, 2;
  s.control.resize(3, 30);
  for (Index i = 0; i < 6; ++i)
    for (Index j = 0; j < 5; ++j) {
      const auto x = static_cast<double>(i);
      const auto y = static_cast<double>(j);
      s.control.col(i * 5 + j) << x + 0.1 * y, 1.3 * y, std::sin(x + 0.7 * y);
    }
  return s;
}

// A plane sheet [0, 4] × [0, 2] with u = x / 4, v = y / 2.
Surface plate() {
  Surface s;
  s.degree_u = 2;
  s.degree_v = 2;
  s.knots_u = uniform_knots(2, 4);
  s.knots_v = uniform_knots(2, 3);
  const VectorXd u = greville(s.knots_u, 2);
  const VectorXd v = greville(s.knots_v, 2);
  s.control.resize(3, u.size() * v.size());
  for (Index i = 0; i < u.size(); ++i)
    for (Index j = 0; j < v.size(); ++j)
      s.control.col(i * v.size() + j) << 4.0 * u[i], 2.0 * v[j], 0.0;
  return s;
}

Matrix2Xd circle(const Vector2d& centre, double radius_u, double radius_v, Index n) {
  Matrix2Xd loop(2, n);
  for (Index i = 0; i < n; ++i) {
    const double a = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    loop.col(i) = centre + Vector2d(radius_u * std::cos(a), radius_v * std::sin(a));
  }
  return loop;
}

double area_of(const velum::Mesh& mesh) {
  double sum = 0.0;
  for (Index i = 0; i < mesh.size(); ++i) {
    const auto at = [&](Index k) -> Vector3d {
      return mesh.positions().col(mesh.triangles()(k, i)).cast<double>();
    };
    sum += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
  }
  return sum;
}

std::size_t loops_in(const velum::Mesh& mesh) {
  const auto adjacency = velum::mesh::adjacency(mesh.triangles());
  CHECK(adjacency.non_manifold_edges == 0);
  return velum::mesh::border_loops(mesh.triangles(), adjacency).size();
}

}  // namespace

TEST_CASE("basis functions are the Bernstein polynomials where there are no inner knots") {
  const VectorXd knots = uniform_knots(3, 1);
  const double x = 0.3;
  const Basis b = basis(knots, 3, x, 3);
  CHECK(b.first == 0);
  CHECK(b.values(0, 0) == Approx(0.343));
  CHECK(b.values(0, 1) == Approx(3 * 0.3 * 0.49));
  CHECK(b.values(0, 3) == Approx(0.027));
  CHECK(b.values(1, 0) == Approx(-3 * 0.49));
  CHECK(b.values(2, 3) == Approx(6 * 0.3));
  CHECK(b.values(3, 0) == Approx(-6.0));
  CHECK(b.values.row(0).sum() == Approx(1.0));
}

TEST_CASE("basis functions sum to one, their derivatives to zero, over uneven and repeated knots") {
  VectorXd knots(12);
  knots << 0, 0, 0, 0, 0.2, 0.5, 0.5, 0.8, 1, 1, 1, 1;
  for (const double x : {0.0, 0.1, 0.2, 0.49, 0.5, 0.77, 0.999, 1.0}) {
    CAPTURE(x);
    const Basis b = basis(knots, 3, x, 2);
    CHECK(b.values.row(0).sum() == Approx(1.0));
    CHECK(std::abs(b.values.row(1).sum()) < 1e-9);
    CHECK(std::abs(b.values.row(2).sum()) < 1e-8);
    double line = 0.0;
    const VectorXd places = greville(knots, 3);
    for (Index k = 0; k < 4; ++k) line += b.values(0, k) * places[b.first + k];
    CHECK(line == Approx(x).margin(1e-12));
  }
}

TEST_CASE("derivatives of a surface agree with differences") {
  for (const bool rational : {false, true}) {
    CAPTURE(rational);
    Surface s = wavy();
    if (rational) {
      s.weights.resize(30);
      for (Index i = 0; i < 30; ++i) s.weights[i] = 1.0 + 0.3 * std::cos(static_cast<double>(i));
    }
    const Patch patch(s);
    const double h = 1e-5;
    for (const Vector2d& uv : {Vector2d(0.2, -0.3), Vector2d(0.37, 0.9), Vector2d(0.8, 1.7)}) {
      const Derivatives d = patch.derivatives(uv);
      const Vector2d eu(h, 0.0);
      const Vector2d ev(0.0, h);
      CHECK((d.point - patch.at(uv)).norm() < 1e-12);
      CHECK((d.du - (patch.at(uv + eu) - patch.at(uv - eu)) / (2 * h)).norm() < 1e-6);
      CHECK((d.dv - (patch.at(uv + ev) - patch.at(uv - ev)) / (2 * h)).norm() < 1e-6);
      const Derivatives right = patch.derivatives(uv + eu);
      const Derivatives left = patch.derivatives(uv - eu);
      const Derivatives above = patch.derivatives(uv + ev);
      const Derivatives below = patch.derivatives(uv - ev);
      CHECK((d.duu - (right.du - left.du) / (2 * h)).norm() < 1e-4);
      CHECK((d.duv - (right.dv - left.dv) / (2 * h)).norm() < 1e-4);
      CHECK((d.dvv - (above.dv - below.dv) / (2 * h)).norm() < 1e-4);
      CHECK(std::abs(d.normal().dot(d.du)) < 1e-9);
    }
  }
}

TEST_CASE("a point of the surface projects to where it came from") {
  const Surface s = wavy();
  const Patch patch(s);
  const Vector2d uv(0.62, 0.81);
  const Derivatives d = patch.derivatives(uv);
  const Vector2d found = patch.project(d.point + 0.02 * d.normal(), {0.5, 0.6});
  CHECK((found - uv).norm() < 1e-7);
  // Beyond the end of the range: the nearest place of the edge.
  const Vector3d outside = patch.at({0.0, 0.5}) - 0.3 * patch.derivatives({0.0, 0.5}).du;
  CHECK(patch.project(outside, {0.2, 0.4}).x() == 0.0);
}

TEST_CASE("surfaces that are not sound are refused") {
  const auto broken = [](const std::function<void(Surface&)>& change) {
    Surface s = wavy();
    change(s);
    CHECK_THROWS_AS(Patch(s), velum::Error);
  };
  broken([](Surface& s) { s.control.conservativeResize(3, 29); });
  broken([](Surface& s) { s.knots_u[5] = 0.1; });
  broken([](Surface& s) { s.degree_v = 0; });
  broken([](Surface& s) { s.knots_v.resize(0); });
  broken([](Surface& s) { s.weights = VectorXd::Zero(30); });
  broken([](Surface& s) { s.control(0, 0) = std::nan(""); });
  broken([](Surface& s) { s.trimming.emplace_back(2, 2); });
}

TEST_CASE("an untrimmed plate is meshed whole, with edges of the wanted length") {
  Alone context;
  const Tessellation made = tessellate(plate(), 0.1, context);
  CHECK(area_of(made.mesh) == Approx(8.0).epsilon(1e-6));
  CHECK(loops_in(made.mesh) == 1);
  double longest = 0.0;
  for (Index i = 0; i < made.mesh.size(); ++i)
    for (Index k = 0; k < 3; ++k) {
      const Eigen::Vector3f edge = made.mesh.positions().col(made.mesh.triangles()(k, i)) -
                                   made.mesh.positions().col(made.mesh.triangles()((k + 1) % 3, i));
      longest = std::max(longest, static_cast<double>(edge.norm()));
    }
  CHECK(longest < 0.2);
  CHECK(made.mesh.size() > 1000);
  CHECK(made.mesh.size() < 4000);
  // Counter-clockwise in (u, v): normals upward.
  const auto t = made.mesh.triangles();
  const auto p = made.mesh.positions();
  for (Index i = 0; i < t.cols(); ++i) {
    const Eigen::Vector3f a = p.col(t(1, i)) - p.col(t(0, i));
    const Eigen::Vector3f b = p.col(t(2, i)) - p.col(t(0, i));
    if (!(a.cross(b).z() > 0.0F)) FAIL_CHECK("triangle " << i << " is turned");
  }
}

TEST_CASE("the border of a trimmed surface has the points of its loops") {
  Surface s = plate();
  s.trimming.push_back(circle({0.5, 0.5}, 0.2, 0.4, 200));
  s.trimming.push_back(circle({0.5, 0.5}, 0.05, 0.1, 60));
  Alone context;
  const Tessellation made = tessellate(s, 0.08, context);
  CHECK(loops_in(made.mesh) == 2);
  // Polygons, not circles, of radius 0.8 and 0.2.
  const double outer = 0.5 * 200 * std::sin(2 * std::numbers::pi / 200) * 0.64;
  const double inner = 0.5 * 60 * std::sin(2 * std::numbers::pi / 60) * 0.04;
  CHECK(area_of(made.mesh) == Approx(outer - inner).epsilon(1e-6));
  CHECK((made.parameters.leftCols(200) - s.trimming[0]).norm() < 1e-12);
}

TEST_CASE("loops that cross, or leave the range, are refused") {
  Alone context;
  Surface s = plate();
  s.trimming.push_back(circle({0.5, 0.5}, 0.2, 0.4, 40));
  s.trimming.push_back(circle({0.65, 0.5}, 0.1, 0.1, 40));
  CHECK_THROWS_AS(tessellate(s, 0.1, context), velum::Error);
  s.trimming = {circle({0.9, 0.5}, 0.2, 0.4, 40)};
  CHECK_THROWS_AS(tessellate(s, 0.1, context), velum::Error);
  s.trimming.clear();
  CHECK_THROWS_AS(tessellate(s, 0.0, context), velum::Error);
  CHECK_THROWS_AS(tessellate(s, 1e-6, context), velum::Error);
}

TEST_CASE("a surface that ends in a point has one vertex there") {
  Surface s = plate();
  const Index rows = count_of(s.knots_v, 2);
  const VectorXd v = greville(s.knots_v, 2);
  for (Index k = 0; k < s.control.cols(); ++k) {
    const double width = 1.0 - v[k % rows];
    s.control(0, k) = 2.0 + (s.control(0, k) - 2.0) * width;
  }
  Alone context;
  const Tessellation made = tessellate(s, 0.1, context);
  CHECK(loops_in(made.mesh) == 1);
  CHECK(area_of(made.mesh) == Approx(4.0).epsilon(1e-3));
  Index at_tip = 0;
  for (Index i = 0; i < made.mesh.positions().cols(); ++i)
    if (made.mesh.positions()(1, i) > 2.0F - 1e-6F) ++at_tip;
  CHECK(at_tip == 1);
}

TEST_CASE("a loop is simplified within the tolerance, and corners stay") {
  const Surface s = plate();
  const Matrix2Xd loop = circle({0.5, 0.5}, 0.2, 0.4, 400);
  const Matrix2Xd less = simplified(s, loop, 0.005, {17});
  CHECK(less.cols() < 60);
  CHECK(less.cols() > 12);
  double nearest = 1.0;
  for (Index i = 0; i < less.cols(); ++i)
    nearest = std::min(nearest, (less.col(i) - loop.col(17)).norm());
  CHECK(nearest == 0.0);
  CHECK(simplified(s, loop, 100.0).cols() >= 3);
}

TEST_CASE("a knot more leaves the surface as it is") {
  const Surface before = wavy();
  Surface after = before;
  insert_knot(after, Along::u, 0.2);
  insert_knot(after, Along::v, 0.5);
  insert_knot(after, Along::v, 1.7);
  CHECK(after.control.cols() == 7 * 7);
  const Patch a(before);
  const Patch b(after);
  for (double u = 0.0; u <= 1.0; u += 0.1)
    for (double v = -1.0; v <= 2.0; v += 0.3) CHECK((a.at({u, v}) - b.at({u, v})).norm() < 1e-12);
}

TEST_CASE("roughness of order 2 spares planes, that of order 3 parabolas") {
  Surface s = plate();
  s.degree_u = s.degree_v = 3;
  s.knots_u = uniform_knots(3, 5);
  s.knots_v = uniform_knots(3, 4);
  const VectorXd u = greville(s.knots_u, 3);
  const VectorXd v = greville(s.knots_v, 3);
  Matrix2Xd places(2, 400);
  Eigen::MatrixXd heights(400, 2);
  for (Index i = 0; i < 400; ++i) {
    places.col(i) << static_cast<double>(i % 20) / 19.0, static_cast<double>(i / 20) / 19.0;
    heights(i, 0) = 2.0 * places(0, i) - places(1, i);
    heights(i, 1) = places(0, i) * places(0, i) + 0.5 * places(0, i) * places(1, i);
  }
  const Smoothed fit = smooth_fit(design(s, places), heights, VectorXd::Ones(400),
                                  roughness(s, 1.0, 2.0, 3), Eigen::MatrixXd(), 1.0);
  CHECK(fit.squares < 1e-12);
  for (const int order : {2, 3}) {
    const Sparse rough = roughness(s, 1.0, 2.0, order);
    const Eigen::MatrixXd energy = fit.coefficients.transpose() * (rough * fit.coefficients);
    CHECK(std::abs(energy(0, 0)) < 1e-8);
    // Of x² + xy/2 over 1 × 2: second derivatives 2 and, twice, 1/4.
    CHECK(energy(1, 1) == Approx(order == 2 ? 2.0 * (4.0 + 2.0 * 0.0625) : 0.0).margin(1e-7));
  }
}

TEST_CASE("cross-validation finds a smooth surface in noise, and smoothness makes it stiffer") {
  Surface s = plate();
  s.degree_u = s.degree_v = 3;
  s.knots_u = uniform_knots(3, 8);
  s.knots_v = uniform_knots(3, 8);
  velum::Random random(3);
  Matrix2Xd places(2, 2000);
  Eigen::MatrixXd heights(2000, 1);
  VectorXd truth(2000);
  for (Index i = 0; i < 2000; ++i) {
    places.col(i) << random.uniform(), random.uniform();
    truth[i] = std::sin(3.0 * places(0, i)) * places(1, i);
    heights(i, 0) = truth[i] + 0.1 * random.gaussian();
  }
  const Sparse rows = design(s, places);
  const Sparse rough = roughness(s, 1.0, 1.0, 3);
  const auto fit = [&](double smoothness) {
    return smooth_fit(rows, heights, VectorXd::Ones(2000), rough, Eigen::MatrixXd(), smoothness);
  };
  const Smoothed usual = fit(1.0);
  const double error = std::sqrt((rows * usual.coefficients.col(0) - truth).squaredNorm() / 2000);
  CHECK(error < 0.02);
  CHECK(usual.freedom < 60.0);
  CHECK(std::sqrt(usual.squares / 2000) == Approx(0.1).epsilon(0.05));
  CHECK(fit(1e4).freedom < usual.freedom);
  CHECK_THROWS_AS(smooth_fit(design(s, places.leftCols(2)), heights.topRows(2), VectorXd::Zero(2),
                             rough, Eigen::MatrixXd(), 1.0),
                  velum::Error);
}
