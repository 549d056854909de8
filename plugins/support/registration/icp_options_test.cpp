// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>

#include "registration/icp.hpp"
#include "registration/sampling.hpp"
#include "registration/test_context.hpp"
#include "registration/test_surfaces.hpp"

using namespace velum;
using namespace velum::registration;
using namespace velum::registration::test;
using velum::test::PlainContext;

namespace {

/// The points of `cloud` whose coordinate along `axis` is below `limit`.
Cloud below(const Cloud& cloud, Index axis, float limit) {
  std::vector<std::int32_t> chosen;
  for (Index i = 0; i < cloud.size(); ++i)
    if (cloud.positions()(axis, i) < limit) chosen.push_back(static_cast<std::int32_t>(i));
  return cloud.select(chosen);
}

Cloud above(const Cloud& cloud, Index axis, float limit) {
  std::vector<std::int32_t> chosen;
  for (Index i = 0; i < cloud.size(); ++i)
    if (cloud.positions()(axis, i) >= limit) chosen.push_back(static_cast<std::int32_t>(i));
  return cloud.select(chosen);
}

int steps_to(const IcpOptions& options, const Cloud& source, const Cloud& target) {
  PlainContext context;
  const IcpResult result = icp(source, target, turned(8.0, {0.03, -0.02, 0.01}), options, context);
  CHECK(error(result, Pose::Identity()).rotation < 1e-5);
  CHECK(error(result, Pose::Identity()).translation < 1e-5);
  return result.iterations;
}

}  // namespace

TEST_CASE("every solver of every metric finds a known motion") {
  const Cloud cloud = bumpy(3000, 1);
  IcpOptions options{.iterations = 200, .relative_change = 0.0};
  for (const Metric metric : {Metric::point_to_point, Metric::point_to_plane, Metric::symmetric})
    for (const Solver solver :
         {Solver::automatic, Solver::svd, Solver::linearised, Solver::helical}) {
      options.metric = metric;
      options.solver = solver;
      PlainContext context;
      INFO("metric " << static_cast<int>(metric) << ", solver " << static_cast<int>(solver));
      if (solver == Solver::svd && metric != Metric::point_to_point) {
        CHECK_THROWS_WITH(icp(cloud, cloud, Pose::Identity(), options, context),
                          Catch::Contains("solver svd is for metric point_to_point"));
      } else {
        steps_to(options, cloud, cloud);
      }
    }
}

TEST_CASE("planes need fewer steps than points, and the symmetric metric the fewest") {
  const Cloud target = bumpy(4000, 1);
  IcpOptions options{.iterations = 200, .relative_change = 0.0};
  const int points = steps_to(options, target, target);
  options.metric = Metric::point_to_plane;
  const int planes = steps_to(options, target, target);
  options.metric = Metric::symmetric;
  const int symmetric = steps_to(options, target, target);
  INFO(points << ", " << planes << ", " << symmetric << " steps");
  CHECK(planes < points);
  CHECK(symmetric <= planes);
}

TEST_CASE("the helical motion keeps its axis and advances by its pitch, and Euler angles do not") {
  Vector6 twist;
  twist << 0.3, -0.9, 0.6, 0.02, 0.05, 0.04;
  const Eigen::Vector3d turn = twist.head<3>();
  const Eigen::Vector3d shift = twist.tail<3>();
  const Eigen::Vector3d centre(1.0, 2.0, 3.0);
  const Eigen::Vector3d on_axis = centre + turn.cross(shift) / turn.squaredNorm();
  const Eigen::Vector3d advance = turn.dot(shift) / turn.squaredNorm() * turn;
  const Pose helical = geometry::exponential(twist, centre);
  CHECK((helical * on_axis - on_axis - advance).norm() < 1e-12);
  CHECK(geometry::angle_of(helical.linear()) == Approx(turn.norm()));
  const Pose euler = euler_motion(twist, centre);
  CHECK((euler * on_axis - on_axis - advance).norm() > 0.01);
  // The same to first order.
  const Vector6 small = 1e-4 * twist;
  const auto miss = geometry::difference(euler_motion(small, centre),
                                         geometry::exponential(small, centre), centre);
  CHECK(miss.rotation < 1e-8);
  CHECK(miss.translation < 1e-8);
}

TEST_CASE("an end by motion comes when the steps are small, whatever the error does") {
  const Cloud cloud = bumpy(3000, 1);
  PlainContext context;
  IcpOptions options{.iterations = 200, .relative_change = 0.0};
  options.still_rotation = 1e-3;
  options.still_translation = 1e-3;
  const IcpResult result = icp(bumpy(3000, 2), cloud, turned(8.0, {0.03, 0, 0}), options, context);
  REQUIRE(result.converged);
  REQUIRE(result.iterations > 2);
  const IcpStep& last = result.steps[result.steps.size() - 2];
  const IcpStep& before = result.steps[result.steps.size() - 3];
  CHECK((last.rotation < 1e-3 && last.translation < 1e-3));
  CHECK((before.rotation >= 1e-3 || before.translation >= 1e-3));
}

TEST_CASE("pairs that are not mutual are left out") {
  const Cloud whole = bumpy(6000, 1);
  const Cloud target = below(whole, 2, 0.15F);
  PlainContext context;
  IcpOptions options{.iterations = 60, .relative_change = 1e-9};
  const Pose start = turned(3.0, {0.02, 0.0, 0.02});
  const IcpResult nearest = icp(whole, target, start, options, context);
  options.pairing = Pairing::reciprocal;
  const IcpResult mutual = icp(whole, target, start, options, context);
  CHECK(mutual.pairs < nearest.pairs);
  CHECK(mutual.pairs <= target.size());
  CHECK(error(mutual, Pose::Identity()).translation <
        0.1 * error(nearest, Pose::Identity()).translation);
}

TEST_CASE("pairs whose normals differ too much are left out, turned ones too") {
  const Cloud target = bumpy(2000, 1);
  Points normals = target.normals();
  normals.leftCols(500) *= -1.0F;
  const Cloud source = target.with(column::kNormals, Column(normals));
  PlainContext context;
  IcpOptions options;
  options.normal_angle = 0.5;
  CHECK(icp(source, target, Pose::Identity(), options, context).pairs == 1500);
  options.normal_angle = 1e-3;
  CHECK_THROWS_WITH(icp(source, target, turned(60, {0, 0, 0}), options, context),
                    Catch::Contains("target point that fits"));
  CHECK_THROWS_WITH(icp(Cloud(Points(source.positions())), target, {}, options, context),
                    Catch::Contains("normals"));
}

TEST_CASE("a normal's sign does not matter to the symmetric metric") {
  const Cloud target = bumpy(3000, 1);
  const Cloud turned_over =
      target.with(column::kNormals, Column(Points(-Points(target.normals()))));
  IcpOptions options{.metric = Metric::symmetric, .iterations = 100, .relative_change = 0.0};
  steps_to(options, turned_over, target);
}

TEST_CASE("samples have the size asked for, the seed's points and the curved ones") {
  Points points = Points::Random(3, 5000);
  Eigen::VectorXf curvature = Eigen::VectorXf::Zero(5000);
  curvature.head(500).setConstant(0.2F);
  const Cloud cloud = Cloud(points).with(column::kCurvature, Column(curvature));
  const auto some = random_sample(cloud, 0.1, 10, Random(1));
  CHECK(some.size() == 500);
  CHECK(std::is_sorted(some.begin(), some.end()));
  CHECK(std::adjacent_find(some.begin(), some.end()) == some.end());
  CHECK(some != random_sample(cloud, 0.1, 10, Random(2)));
  CHECK(random_sample(cloud, 1e-6, 10, Random(1)).size() == 10);
  CHECK(random_sample(cloud, 1.0, 10, Random(1)).size() == 5000);
  const auto curved = curvature_sample(cloud, 0.1, 10, Random(1));
  const auto high = std::count_if(curved.begin(), curved.end(), [](auto i) { return i < 500; });
  CHECK(curved.size() > 400);
  CHECK(curved.size() <= 501);
  // 500 points of weight 0.2 against 4500 of a tenth of the mean, 0.002.
  CHECK(static_cast<double>(high) / static_cast<double>(curved.size()) > 0.85);
  CHECK(high < static_cast<std::ptrdiff_t>(curved.size()));
}

TEST_CASE("a tenth of the source ends near the pose that all of it finds") {
  const Cloud target = bumpy(20000, 1, 0.002)
                           .with(column::kCurvature,
                                 Column(Eigen::VectorXf(Eigen::VectorXf::Constant(20000, 0.01F))));
  PlainContext context;
  IcpOptions options{.metric = Metric::point_to_plane, .relative_change = 1e-6};
  for (const Sampling sampling : {Sampling::random, Sampling::curvature}) {
    options.sampling = sampling;
    const IcpResult result =
        icp(target, bumpy(20000, 2, 0.002), turned(5, {0, 0.02, 0}), options, context);
    CHECK(result.pairs == Approx(2000).margin(2));
    CHECK(error(result, Pose::Identity()).translation < 1e-3);
  }
}

TEST_CASE("kernels stand a third of points that lie beside the surface") {
  const Cloud target = bumpy(6000, 1, 0.001);
  Points points = bumpy(6000, 2, 0.001).positions();
  for (Index i = 0; i < 2000; ++i) points(2, 3 * i) += 0.05F;
  const Cloud source(points);
  PlainContext context;
  IcpOptions options{.metric = Metric::point_to_plane, .iterations = 100, .relative_change = 1e-8};
  const auto miss = [&] {
    return error(icp(source, target, turned(3, {0.02, 0, 0}), options, context), Pose::Identity())
        .translation;
  };
  const double plain = miss();
  options.kernel = Kernel::huber;
  const double huber = miss();
  options.kernel = Kernel::tukey;
  const double tukey = miss();
  options.kernel_scale = 0.002;
  const double given = miss();
  INFO(plain << ", " << huber << ", " << tukey << ", " << given);
  CHECK(plain > 0.01);
  CHECK(huber < 0.5 * plain);
  CHECK(tukey < 0.3e-3);
  CHECK(given < 0.3e-3);
}

TEST_CASE("an overlap of a third is enough from a near start (thesis: fails under one half)") {
  const Cloud a = bumpy(12000, 1, 0.002);
  const Cloud b = bumpy(12000, 2, 0.002);
  const Cloud target = below(a, 2, 0.05F);
  const Cloud source = above(b, 2, -0.25F);
  const double share =
      static_cast<double>(below(source, 2, 0.05F).size()) / static_cast<double>(source.size());
  CHECK(share < 0.5);
  PlainContext context;
  const Pose start = turned(6.0, {0.03, -0.02, 0.03});
  const auto miss = [&](const IcpOptions& options) {
    return error(icp(source, target, start, options, context), Pose::Identity());
  };
  CHECK(miss({.iterations = 100}).translation > 0.02);
  IcpOptions options{
      .metric = Metric::symmetric, .max_distance = 0.1, .iterations = 100, .relative_change = 1e-6};
  options.kernel = Kernel::tukey;
  INFO(share << ": " << miss(options).rotation / kDegree << " deg, " << miss(options).translation);
  CHECK(miss(options).rotation < 0.5 * kDegree);
  CHECK(miss(options).translation < 1e-3);
}
