// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <limits>
#include <numbers>
#include <velum/testing.hpp>

using velum::Transform;
using velum::test::Stage;

namespace {

Transform moved(double angle, const Eigen::Vector3d& shift) {
  Transform transform;
  transform.matrix.linear() =
      Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 1, 0).normalized()).toRotationMatrix();
  transform.matrix.translation() = shift;
  return transform;
}

velum::test::Outcome compared(const Transform& a, const Transform& b) {
  return Stage("analysis.registration_error").run(a, b);
}

}  // namespace

TEST_CASE("equal transforms have no error") {
  const auto outcome = compared(moved(0.4, {1, 2, 3}), moved(0.4, {1, 2, 3}));
  CHECK(outcome.measure("rotation") == Approx(0.0).margin(1e-12));
  CHECK(outcome.measure("translation") == 0.0);
}

TEST_CASE("a shift is all translation") {
  const auto outcome = compared(moved(0.4, {1, 2, 3}), moved(0.4, {1, 2, 3.5}));
  CHECK(outcome.measure("rotation") == Approx(0.0).margin(1e-12));
  CHECK(outcome.measure("translation") == Approx(0.5));
  CHECK(outcome.get<velum::Table>().number(0, "z") == Approx(-500.0));
}

TEST_CASE("rotation is the angle between the two, however small") {
  for (const double angle : {1e-9, 1e-4, 0.3, 3.0}) {
    const auto outcome = compared(moved(0.1 + angle, {0, 0, 0}), moved(0.1, {0, 0, 0}));
    CHECK(outcome.measure("rotation") == Approx(angle).epsilon(1e-6));
  }
}

TEST_CASE("it does not matter which of the two is the truth") {
  const Transform a = moved(0.4, {1, 2, 3});
  const Transform b = moved(-0.1, {1, 2, 4});
  CHECK(compared(a, b).measure("rotation") == Approx(compared(b, a).measure("rotation")));
  CHECK(compared(a, b).measure("translation") == Approx(compared(b, a).measure("translation")));
}

TEST_CASE("the translation is measured where it is asked for") {
  Transform turned = moved(0.0, {0, 0, 0});
  turned.matrix.linear() = Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const auto outcome = Stage("analysis.registration_error")
                           .set("point", "[\"10 m\", 0, 0]")
                           .run(turned, Transform());
  CHECK(outcome.measure("translation") == Approx(0.1).epsilon(1e-4));
  CHECK(compared(turned, Transform()).measure("translation") == 0.0);
}

TEST_CASE("the table is in degrees and millimetres") {
  const auto outcome = compared(moved(std::numbers::pi / 2, {0.25, 0, 0}), moved(0.0, {0, 0, 0}));
  CHECK(outcome.get<velum::Table>().number(0, "rotation") == Approx(90.0));
  CHECK(outcome.get<velum::Table>().number(0, "translation") == Approx(250.0));
}

TEST_CASE("a transform that holds NaN is refused") {
  CHECK_THROWS_WITH(
      compared(moved(0.0, {std::numeric_limits<double>::quiet_NaN(), 0, 0}), Transform()),
      Catch::Contains("not finite"));
}

TEST_CASE("comparing keeps to the promises of every stage") {
  for (const auto& fault : velum::test::conformance("analysis.registration_error"))
    FAIL_CHECK(fault);
}
