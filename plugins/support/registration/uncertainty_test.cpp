// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/uncertainty.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "registration/icp.hpp"
#include "registration/test_context.hpp"
#include "registration/test_surfaces.hpp"

using namespace velum;
using namespace velum::registration;
using namespace velum::registration::test;
using velum::test::PlainContext;

namespace {

/// Points and normals of a surface given by position and normal at random parameters.
template <class At>
Cloud surface(Index n, std::uint64_t seed, const At& at) {
  Random random(seed);
  Points points(3, n);
  Points normals(3, n);
  for (Index i = 0; i < n; ++i) {
    const auto [point, normal] = at(random);
    points.col(i) = point.template cast<float>();
    normals.col(i) = normal.template cast<float>();
  }
  return Cloud(points).with(column::kNormals, Column(normals));
}

using Oriented = std::pair<Eigen::Vector3d, Eigen::Vector3d>;

Oriented on_cylinder(Random& random) {
  const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
  const Eigen::Vector3d normal(std::cos(angle), std::sin(angle), 0.0);
  return {0.5 * normal + random.uniform(-1.0, 1.0) * Eigen::Vector3d::UnitZ(), normal};
}

Oriented on_sphere(Random& random) {
  const Eigen::Vector3d normal =
      Eigen::Vector3d(random.gaussian(), random.gaussian(), random.gaussian()).normalized();
  return {0.5 * normal, normal};
}

/// Registers pairs of noisy clouds of one surface; root mean squares of what was missed beside what
/// was foretold.
struct Trials {
  double turn = 0.0, turn_said = 0.0, shift = 0.0, shift_said = 0.0;
};
Trials trials(const IcpOptions& options, Index source_points, Index target_points) {
  constexpr int kTrials = 60;
  Trials sums;
  for (std::uint64_t k = 0; k < kTrials; ++k) {
    PlainContext context;
    const Cloud target = bumpy(target_points, 1000 + k, 0.004);
    const Cloud source = bumpy(source_points, 2000 + k, 0.004);
    const IcpResult result = icp(source, target, turned(0.3, {0.002, 0, 0}), options, context);
    const Eigen::Vector3d centre = result.pose.inverse() * result.uncertainty.centre;
    const auto miss = geometry::difference(result.pose, Pose::Identity(), centre);
    const Matrix6& covariance = result.uncertainty.covariance;
    sums.turn += miss.rotation * miss.rotation / kTrials;
    sums.shift += miss.translation * miss.translation / kTrials;
    sums.turn_said += covariance.topLeftCorner<3, 3>().trace() / kTrials;
    sums.shift_said += covariance.bottomRightCorner<3, 3>().trace() / kTrials;
  }
  return {std::sqrt(sums.turn), std::sqrt(sums.turn_said), std::sqrt(sums.shift),
          std::sqrt(sums.shift_said)};
}

}  // namespace

TEST_CASE("the covariance is that of a Monte Carlo") {
  for (const Metric metric : {Metric::point_to_plane, Metric::symmetric})
    // As dense as each other, and a target whose points serve many pairs each.
    for (const Index target_points : {1500, 400}) {
      const IcpOptions options{.metric = metric, .iterations = 30, .relative_change = 1e-7};
      const Trials found = trials(options, 1500, target_points);
      INFO("metric " << static_cast<int>(metric) << ", " << target_points << " target points: turn "
                     << found.turn << " rad, said " << found.turn_said << "; shift " << found.shift
                     << " m, said " << found.shift_said);
      CHECK(found.turn_said / found.turn == Approx(1.0).margin(0.3));
      CHECK(found.shift_said / found.shift == Approx(1.0).margin(0.3));
    }
}

TEST_CASE("what a plane, a cylinder and a sphere leave free is named, whatever the metric") {
  const Cloud plane = flat(40);
  const Cloud cylinder = surface(4000, 1, on_cylinder);
  const Cloud sphere = surface(4000, 1, on_sphere);
  for (const Metric metric : {Metric::point_to_point, Metric::point_to_plane, Metric::symmetric})
    for (const bool normals : {true, false}) {
      if (!normals && metric != Metric::point_to_point) continue;
      INFO("metric " << static_cast<int>(metric));
      PlainContext context;
      const auto of = [&](const Cloud& cloud) {
        const Cloud given = normals ? cloud : cloud.without(column::kNormals);
        return icp(given, given, Pose::Identity(), {.metric = metric}, context).uncertainty;
      };
      const Uncertainty level = of(plane);
      CHECK(level.free == 3);
      // Turns about z and shifts along x and y: nothing of the other three.
      for (int k = 0; k < 3; ++k)
        CHECK(std::abs(level.directions.axes(0, k)) + std::abs(level.directions.axes(1, k)) +
                  std::abs(level.directions.axes(5, k)) <
              1e-3);
      const Uncertainty round = of(cylinder);
      CHECK(round.free == 2);
      for (int k = 0; k < 2; ++k) {
        const Vector6 axis = round.directions.axes.col(k);
        CHECK(std::hypot(axis[2], axis[5]) > 0.99);
        CHECK(std::isinf(round.deviation[k]));
      }
      const Uncertainty ball = of(sphere);
      CHECK(ball.free == 3);
      CHECK(ball.directions.axes.topLeftCorner<3, 3>().norm() > 1.7);
      CHECK(of(bumpy(4000, 1)).free == 0);
    }
}

TEST_CASE("free directions are left out of the covariance, and the tables say so") {
  PlainContext context;
  const Cloud plane = flat(40);
  Pose start = Pose::Identity();
  start.translation().z() = 0.01;
  const IcpResult result =
      icp(plane, plane, start, {.metric = Metric::point_to_plane, .iterations = 1}, context);
  CHECK(std::isfinite(result.uncertainty.translation()));
  CHECK(std::isfinite(result.uncertainty.rotation()));
  const Table directions = directions_table(result.uncertainty);
  REQUIRE(directions.size() == 6);
  CHECK(directions.number(0, "free") == 1);
  CHECK(directions.number(2, "free") == 1);
  CHECK(directions.number(3, "free") == 0);
  CHECK(covariance_table(result.uncertainty).size() == 6);
  CHECK_THAT(describe_direction(result.uncertainty.directions.axes.col(5)),
             Catch::Contains("sliding along (0.00, 0.00, "));
}
