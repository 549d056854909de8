// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "features/histograms.hpp"
#include "global/judge.hpp"
#include "global/matches.hpp"
#include "registration/test_context.hpp"
#include "registration/test_surfaces.hpp"

using namespace velum::registration;
using namespace velum::registration::test;
using velum::Cloud;
using velum::Index;
using velum::Points;
using velum::Pose;
using velum::test::PlainContext;

namespace {

constexpr double kCell = 0.06;

Sampled sampled(const Cloud& cloud, velum::Context& context, Index keys = 2500) {
  SampleOptions options;
  options.cell = kCell;
  options.keys = keys;
  return sample(cloud, options, context);
}

/// `share` of the columns in one bin, the others each in one of their own.
Eigen::MatrixXf mostly_alike(Index count, Index alike) {
  Eigen::MatrixXf columns = Eigen::MatrixXf::Zero(velum::features::kFpfhBins, count);
  for (Index i = 0; i < count; ++i) columns(i < alike ? 5 : 6 + i - alike, i) = 100.0F;
  return columns;
}

}  // namespace

TEST_CASE("what is common counts as little as it is common, what is rare in full") {
  PlainContext one(1);
  PlainContext two(2);
  const Eigen::MatrixXf columns = mostly_alike(100, 95);
  const auto rare = rarity(columns, one);
  for (std::size_t i = 0; i < 95; ++i) CHECK(rare[i] == Approx(0.05 / 0.95));
  for (std::size_t i = 95; i < 100; ++i) CHECK(rare[i] == 1.0F);
  CHECK(rare == rarity(columns, two));
}

TEST_CASE("a surface seen from behind is as common as from before") {
  PlainContext context;
  Eigen::MatrixXf columns = mostly_alike(40, 40);
  columns.rightCols(20).setZero();
  columns.row(5).rightCols(20).setZero();
  columns.leftCols(20).setZero();
  columns.row(2).leftCols(20).setConstant(100.0F);
  columns.row(8).rightCols(20).setConstant(100.0F);
  for (const float one : rarity(columns, context)) CHECK(one == Approx(0.05));
}

TEST_CASE("no features, and those that are empty, tell nothing") {
  PlainContext context;
  CHECK(rarity(Eigen::MatrixXf(velum::features::kFpfhBins, 0), context).empty());
  Eigen::MatrixXf columns = mostly_alike(10, 9);
  columns.col(4).setZero();
  CHECK(rarity(columns, context)[4] == 0.0F);
}

TEST_CASE("normals of any sign are made to agree over a closed sheet") {
  PlainContext context;
  const Cloud cloud = bumpy(1500, 1);
  Points normals = cloud.normals();
  velum::Random random(4);
  for (Index i = 0; i < normals.cols(); ++i)
    if (random.uniform() < 0.5) normals.col(i) *= -1.0F;
  agree_on_sign(cloud, normals, 10, context);
  Index outwards = 0;
  for (Index i = 0; i < normals.cols(); ++i)
    outwards += normals.col(i).dot(cloud.normals().col(i)) > 0.0F ? 1 : 0;
  CHECK((outwards == 0 || outwards == normals.cols()));
}

TEST_CASE("a cloud is thinned to a point a cell, with as many keys as wanted") {
  PlainContext context;
  const Sampled thin = sampled(bumpy(6000, 1), context, 100);
  CHECK(thin.cloud.size() < 6000);
  CHECK(thin.keys.size() == 100);
  CHECK(thin.features.cols() == 100);
  CHECK(thin.rarity.size() == static_cast<std::size_t>(thin.cloud.size()));
  CHECK(thin.cell == kCell);
}

TEST_CASE("one point and points in one place are sampled to one point without features") {
  PlainContext context;
  for (const Index count : {1, 20}) {
    const Sampled thin = sampled(Cloud(Points::Ones(3, count)), context);
    CHECK(thin.cloud.size() == 1);
    CHECK(thin.keys.empty());
  }
}

TEST_CASE("every point of a cloud matches itself first") {
  PlainContext context;
  const Sampled cloud = sampled(bumpy(6000, 1), context);
  const auto matches = match_features(cloud, cloud, 3, 5000, context);
  REQUIRE(matches.size() > cloud.keys.size() / 2);
  std::size_t itself = 0;
  for (std::size_t i = 0; i < cloud.keys.size() / 2; ++i)
    itself += matches[i].from == matches[i].to ? 1 : 0;
  CHECK(itself > cloud.keys.size() * 49 / 100);
  CHECK(match_features(cloud, cloud, 3, 7, context).size() == 7);
}

TEST_CASE("a cloud lies on itself, and not on itself far away") {
  PlainContext context;
  const Sampled cloud = sampled(bumpy(6000, 1), context);
  const Judge judge(cloud, cloud, context);
  const Agreement here = judge.agreement(Pose::Identity(), cloud.cloud.size());
  CHECK(here.share == Approx(1.0));
  CHECK(here.overlap == Approx(1.0));
  CHECK(here.fitness == Approx(0.0));
  CHECK(here.evidence > 0.0);
  Pose away = Pose::Identity();
  away.translation().x() = 3.0;
  const Agreement there = judge.agreement(away, cloud.cloud.size());
  CHECK(there.share == 0.0);
  CHECK(there.overlap == 0.0);
  CHECK(there.evidence == 0.0);
}

TEST_CASE("refinement brings another sample of the surface to a small part of a cell") {
  PlainContext context;
  const Sampled source = sampled(bumpy(6000, 1), context);
  const Sampled target = sampled(bumpy(6000, 2), context);
  const Judge judge(source, target, context);
  const auto refined =
      judge.refine(turned(6.0, {0.03, -0.03, 0.02}), 3.0 * kCell, kCell, source.cloud.size());
  const auto miss = velum::geometry::difference(refined.pose, Pose::Identity());
  CHECK(miss.rotation < 0.01);
  CHECK(miss.translation < 0.1 * kCell);
  CHECK(!refined.steps.empty());
}
