// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <velum/random.hpp>

#include "sail/curve.hpp"
#include "sail/penalised.hpp"

using namespace velum::sail;
using Eigen::Index;

TEST_CASE("the basis sums to one, and its slopes to zero") {
  for (const double u : {0.0, 0.13, 0.5, 0.99, 1.0}) {
    CHECK(basis(u, 7).sum() == Approx(1.0));
    CHECK(basis_slope(u, 7).sum() == Approx(0.0).margin(1e-12));
    const Eigen::RowVectorXd step = (basis(u + 1e-6, 7) - basis(u - 1e-6, 7)) / 2e-6;
    CHECK((step - basis_slope(u, 7)).norm() < 1e-5);
  }
}

TEST_CASE("a penalised fit leaves a straight line alone and takes noise out of it") {
  velum::Random random(3);
  const Index n = 200;
  Eigen::MatrixXd design(n, 13);
  Eigen::VectorXd values(n);
  for (Index i = 0; i < n; ++i) {
    const double u = static_cast<double>(i) / static_cast<double>(n - 1);
    design.row(i) = basis(u, 10);
    values[i] = 2.0 * u + 0.1 * random.gaussian();
  }
  const Fit fit =
      fit_penalised(design, values, Eigen::VectorXd::Ones(n), difference_penalty(13, 2), 1e9);
  double worst = 0.0;
  for (Index i = 0; i < n; ++i)
    worst = std::max(worst, std::abs(design.row(i).dot(fit.coefficients.col(0)) -
                                     2.0 * static_cast<double>(i) / static_cast<double>(n - 1)));
  CHECK(worst < 0.05);
  CHECK(fit.freedom < 8.0);
}

TEST_CASE("zigzag does not lengthen a smooth curve") {
  velum::Random random(5);
  const Index n = 300;
  Eigen::Matrix3Xd points(3, n);
  Eigen::VectorXd share(n);
  for (Index i = 0; i < n; ++i) {
    const double a = 1.5 * static_cast<double>(i) / static_cast<double>(n - 1);
    const double radius = 1.0 + 0.005 * random.gaussian();
    points.col(i) << radius * std::cos(a), radius * std::sin(a), 0.0;
    share[i] = a / 1.5;
  }
  const Curve curve = smooth_curve(points, share, Eigen::VectorXd::Ones(n));
  CHECK(curve.length() == Approx(1.5).epsilon(0.01));
  CHECK(Curve(points).length() > 1.6);
}

TEST_CASE("a curve is cut or lengthened to a point, and found at a height") {
  Eigen::Matrix3Xd points(3, 101);
  for (Index i = 0; i <= 100; ++i) points.col(i) << 0.0, 0.0, 0.01 * static_cast<double>(i);
  const Curve line(points);
  CHECK(line.ending_at({0, 0, 0.5}).length() == Approx(0.5));
  CHECK(line.ending_at({0, 0, 1.2}).length() == Approx(1.2));
  CHECK(line.starting_at({0, 0, -0.2}).length() == Approx(1.2));
  CHECK(line.at_height(0.333)->z() == Approx(0.333));
  CHECK_FALSE(line.at_height(1.5));
  CHECK(line.nearest({0.3, 0, 0.25}) == Approx(0.25));
}
