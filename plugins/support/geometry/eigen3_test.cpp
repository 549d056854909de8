// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "geometry/eigen3.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <velum/random.hpp>

using velum::geometry::eigen3;
using velum::geometry::eigenvalues3;
using velum::geometry::smallest_eigenvector3;

namespace {

Eigen::Matrix3d with_values(const Eigen::Vector3d& values, velum::Random& random) {
  const Eigen::Quaterniond turn(random.gaussian(), random.gaussian(), random.gaussian(),
                                random.gaussian());
  const Eigen::Matrix3d r = turn.normalized().toRotationMatrix();
  return r * values.asDiagonal() * r.transpose();
}

void check_decomposition(const Eigen::Matrix3d& m) {
  const auto [values, vectors] = eigen3(m);
  const double scale = m.norm();
  CHECK((m * vectors - vectors * values.asDiagonal()).norm() <= 1e-14 * scale);
  CHECK((vectors.transpose() * vectors - Eigen::Matrix3d::Identity()).norm() < 1e-14);
  CHECK(values[0] <= values[1]);
  CHECK(values[1] <= values[2]);
}

}  // namespace

TEST_CASE("Jacobi decomposes matrices of every size and shape") {
  velum::Random random(1);
  for (const double scale : {1e-30, 1e-6, 1.0, 1e12})
    for (const Eigen::Vector3d& values :
         {Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1e-9, 1, 1), Eigen::Vector3d(0, 0, 1),
          Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(0, 1, 1 + 1e-12)})
      for (int i = 0; i < 20; ++i) check_decomposition(with_values(scale * values, random));
}

TEST_CASE("the zero matrix has an orthonormal frame") {
  const auto [values, vectors] = eigen3(Eigen::Matrix3d::Zero());
  CHECK(values.isZero());
  CHECK(vectors.isIdentity());
}

TEST_CASE("closed-form eigenvalues agree with Jacobi") {
  velum::Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d values(random.uniform() * 1e-3, 0.5 + random.uniform(), 2.0);
    const Eigen::Matrix3d m = with_values(values, random);
    CHECK((eigenvalues3(m) - eigen3(m).values).norm() < 1e-12);
  }
  CHECK((eigenvalues3(Eigen::Matrix3d::Identity() * 4.0) - Eigen::Vector3d::Constant(4.0)).norm() <
        1e-12);
}

TEST_CASE("the smallest eigenvalue of a disc is accurate to rounding") {
  velum::Random random(3);
  const Eigen::Matrix3d m = with_values({1e-10, 1.0, 1.0}, random);
  CHECK(std::abs(eigenvalues3(m)[0] - 1e-10) < 1e-14);
}

TEST_CASE("the normal of a covariance is found in both branches") {
  velum::Random random(4);
  for (const Eigen::Vector3d& values :
       {Eigen::Vector3d(1e-4, 1, 1.5), Eigen::Vector3d(0, 1e-7, 1), Eigen::Vector3d(0, 1, 1)}) {
    const Eigen::Matrix3d m = with_values(values, random);
    const Eigen::Vector3d n = smallest_eigenvector3(m, eigenvalues3(m));
    CHECK(n.norm() == Approx(1.0).epsilon(1e-12));
    CHECK((m * n - values[0] * n).norm() < 1e-9);
  }
}
