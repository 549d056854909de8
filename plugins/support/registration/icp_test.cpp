// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/icp.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "registration/overlap.hpp"
#include "registration/pairs.hpp"
#include "registration/test_context.hpp"
#include "registration/test_surfaces.hpp"

using namespace velum;
using namespace velum::registration;
using namespace velum::registration::test;
using velum::test::PlainContext;

TEST_CASE("the same points moved are found to rounding by both metrics") {
  const Cloud target = bumpy(5000, 1);
  const Pose truth = turned(8.0, {0.03, -0.02, 0.01});
  const Cloud source = target.transformed(truth.inverse());
  PlainContext context;
  for (const Metric metric : {Metric::point_to_point, Metric::point_to_plane}) {
    const IcpOptions options{.metric = metric, .iterations = 100, .relative_change = 0.0};
    const IcpResult result =
        icp(source, target, geometry::to_local(Pose::Identity(), source.origin(), target.origin()),
            options, context);
    const auto found = geometry::to_true(result.pose, source.origin(), target.origin());
    CHECK(geometry::difference(found, truth).rotation < 1e-6);
    CHECK(geometry::difference(found, truth).translation < 1e-6);
    CHECK(result.fitness < 1e-12);
    CHECK(result.overlap == 1.0);
  }
}

TEST_CASE("noise is averaged away by point to plane") {
  const Cloud target = bumpy(20000, 1, 0.004);
  const Cloud source = bumpy(20000, 2, 0.004);
  PlainContext context;
  const Pose start = turned(5.0, {0.02, 0.02, 0.0});
  const IcpResult result = icp(
      source, target, start,
      {.metric = Metric::point_to_plane, .max_distance = 0.1, .relative_change = 1e-4}, context);
  CHECK(error(result, Pose::Identity()).rotation < 0.1 * kDegree);
  CHECK(error(result, Pose::Identity()).translation < 0.3e-3);
  CHECK(result.converged);
}

TEST_CASE("it ends by the change of the error or by the number of iterations") {
  const Cloud target = bumpy(3000, 1, 0.002);
  const Cloud source = bumpy(3000, 2, 0.002);
  PlainContext context;
  const IcpResult thesis = icp(source, target, turned(5.0, {0, 0, 0}), {}, context);
  CHECK(thesis.converged);
  CHECK(thesis.iterations < 25);
  CHECK(thesis.steps.back().relative_change < 1e-3);
  CHECK(thesis.steps.size() == static_cast<std::size_t>(thesis.iterations) + 1);
  const IcpResult two = icp(source, target, turned(5.0, {0, 0, 0}), {.iterations = 2}, context);
  CHECK_FALSE(two.converged);
  CHECK(two.iterations == 2);
  CHECK(two.steps[1].error < two.steps[0].error);
  CHECK(history_table(two.steps).size() == 3);
}

TEST_CASE("a plane leaves two shifts and a turn free, and they are not moved") {
  const Cloud target = flat(40);
  PlainContext context;
  Pose start = Pose::Identity();
  start.translation().z() = 0.05;
  const IcpResult result =
      icp(target, target, start, {.metric = Metric::point_to_plane, .iterations = 20}, context);
  CHECK(error(result, Pose::Identity()).translation < 1e-6);
  CHECK((result.uncertainty.directions.strength.array() < 1e-9).count() == 3);
  CHECK(result.uncertainty.directions.strength[3] > 0.1);
}

TEST_CASE("a line leaves the turn about itself and the way along it free, and does not spin") {
  Points points = Points::Zero(3, 50);
  for (Index i = 0; i < 50; ++i) points(0, i) = static_cast<float>(i) * 0.1F;
  const Cloud line(points);
  PlainContext context;
  Pose start = Pose::Identity();
  start.translation() << 0.01, 0.02, 0.03;
  const IcpResult result = icp(line, line, start, {}, context);
  CHECK(error(result, Pose::Identity()).rotation < 1e-6);
  CHECK(error(result, Pose::Identity()).translation < 1e-6);
  CHECK(result.uncertainty.free == 2);
  CHECK(result.uncertainty.directions.strength[2] > 0.01);
}

TEST_CASE("empty clouds, one point and clouds too far apart are refused with the reason") {
  const Cloud target = bumpy(500, 1);
  PlainContext context;
  CHECK_THROWS_WITH(icp(Cloud(), target, Pose::Identity(), {}, context),
                    Catch::Contains("source has no points"));
  CHECK_THROWS_WITH(icp(target, Cloud(), Pose::Identity(), {}, context),
                    Catch::Contains("target has no points"));
  const std::vector<std::int32_t> one{0};
  CHECK_THROWS_WITH(icp(target.select(one), target, Pose::Identity(), {}, context),
                    Catch::Contains("1 of 1 source points"));
  CHECK_THROWS_WITH(icp(target, target, turned(0, {9, 0, 0}), {.max_distance = 0.5}, context),
                    Catch::Contains("0 of 500 source points have a target point within 0.5 m"));
}

TEST_CASE("points that all lie in one place do not make a turn") {
  const Cloud heap(Points(Points::Constant(3, 20, 1.0F)));
  PlainContext context;
  const IcpResult result = icp(heap, heap, turned(0, {0, 0, 1}), {}, context);
  CHECK(error(result, Pose::Identity()).translation < 1e-6);
}

TEST_CASE("trimming stands a part that only the source has") {
  const Cloud whole = bumpy(8000, 1);
  std::vector<std::int32_t> lower;
  for (Index i = 0; i < whole.size(); ++i)
    if (whole.positions()(2, i) < 0.2F) lower.push_back(static_cast<std::int32_t>(i));
  const Cloud target = whole.select(lower);
  PlainContext context;
  const Pose start = turned(4.0, {0.02, 0.0, 0.02});
  IcpOptions options{.iterations = 80, .relative_change = 1e-9};
  const double plain =
      error(icp(whole, target, start, options, context), Pose::Identity()).translation;
  options.keep = 0.6;
  const double trimmed =
      error(icp(whole, target, start, options, context), Pose::Identity()).translation;
  CHECK(trimmed < 1e-4);
  CHECK(plain > 10.0 * trimmed);
}

TEST_CASE("levels from coarse to fine end at the same pose") {
  const Cloud target = bumpy(20000, 1, 0.002);
  const Cloud source = bumpy(20000, 2, 0.002);
  PlainContext context;
  IcpOptions options{.metric = Metric::point_to_plane, .relative_change = 1e-6};
  const IcpResult fine = icp(source, target, turned(5, {0, 0, 0.02}), options, context);
  options.levels = 3;
  const IcpResult coarse = icp(source, target, turned(5, {0, 0, 0.02}), options, context);
  CHECK(geometry::difference(fine.pose, coarse.pose).translation < 1e-4);
  CHECK(coarse.steps.front().pairs == 1250);
  CHECK(coarse.steps.back().pairs == 20000);
}

TEST_CASE("the same bytes with one and with three threads") {
  const Cloud target = bumpy(20000, 1, 0.002);
  const Cloud source = bumpy(20000, 2, 0.002);
  PlainContext one(1);
  PlainContext three(3);
  const IcpResult a = icp(source, target, turned(5, {0, 0, 0.02}), {}, one);
  const IcpResult b = icp(source, target, turned(5, {0, 0, 0.02}), {}, three);
  CHECK(a.pose.matrix() == b.pose.matrix());
  CHECK(a.fitness == b.fitness);
}

TEST_CASE("matches kept from pose to pose are those of a full search") {
  const Cloud target = bumpy(4000, 1);
  ClosestPairs pairs(bumpy(3000, 2).positions(), target);
  PlainContext context;
  Index spared = 0;
  for (int step = 0; step < 12; ++step) {
    const Pose pose = turned(4.0 / (1 << step), {0.1 / (1 << step), 0, 0});
    pairs.update(pose, 0.05, context);
    spared += pairs.size() - pairs.searched();
    Index wrong = 0;
    for (Index i = 0; i < pairs.size(); ++i) {
      const Neighbour true_one =
          target.neighbours().nearest_one(pairs.moved(i).cast<float>(), 0.05);
      const bool close = std::abs(std::sqrt(true_one.distance2) - 0.05F) < 1e-6F;
      wrong += pairs.match(i) != true_one.index && !close ? 1 : 0;
    }
    CHECK(wrong == 0);
  }
  CHECK(spared > pairs.size());
}

TEST_CASE("the overlap filter keeps the points near the other cloud") {
  const Cloud a = flat(20);
  PlainContext context;
  CHECK(overlapping(a, a, turned(0, {1.0, 0, 0}), 0.051, context).size() == 200);
  CHECK(overlapping(a, a, turned(0, {0, 0, 1.0}), 0.5, context).empty());
  CHECK(overlapping(a, Cloud(), Pose::Identity(), 0.5, context).empty());
}

TEST_CASE("an interruption ends it") {
  const Cloud target = bumpy(500, 1);
  PlainContext context;
  context.stop = true;
  CHECK_THROWS_AS(icp(target, target, Pose::Identity(), {}, context), Cancelled);
}
