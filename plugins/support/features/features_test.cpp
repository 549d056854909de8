// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "features/histograms.hpp"
#include "features/matching.hpp"
#include "registration/test_context.hpp"

using velum::Cloud;
using velum::Column;
using velum::Index;
using velum::Points;
using velum::test::PlainContext;
namespace features = velum::features;

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
const features::Neighbourhood kWithin{{}, 0.15};

Cloud with_normals(Points points, Points normals, const Eigen::Vector3d& origin = {0, 0, 0}) {
  return Cloud(std::move(points), origin).with(velum::column::kNormals, Column(std::move(normals)));
}

/// Hills over 1 m with their exact normals.
Cloud hills(const Eigen::Vector3d& origin = {0, 0, 0}) {
  velum::Random random(3);
  Points points(3, 800);
  Points normals(3, 800);
  for (Index i = 0; i < points.cols(); ++i) {
    const double x = random.uniform();
    const double y = random.uniform();
    points.col(i) = Eigen::Vector3d(x, y, 0.1 * std::sin(7.0 * x) * y).cast<float>();
    normals.col(i) = Eigen::Vector3d(-0.7 * std::cos(7.0 * x) * y, -0.1 * std::sin(7.0 * x), 1.0)
                         .normalized()
                         .cast<float>();
  }
  return with_normals(std::move(points), std::move(normals), origin);
}

/// `count` points on the x axis, 0.1 m apart, with this normal.
Cloud row_of(Index count, const Eigen::Vector3f& normal) {
  Points points = Points::Zero(3, count);
  for (Index i = 0; i < count; ++i) points(0, i) = 0.1F * static_cast<float>(i);
  return with_normals(std::move(points), normal.replicate(1, count));
}

/// By how much of a column two sets of histograms differ, in the mean; rounding moves some pairs
/// into the next bin.
double difference(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b) {
  return static_cast<double>((a - b).cwiseAbs().sum() / a.cwiseAbs().sum());
}

}  // namespace

TEST_CASE("what is flat fills the middle bin of every angle") {
  PlainContext context;
  const Cloud flat = row_of(5, Eigen::Vector3f::UnitZ());
  const Eigen::MatrixXf fast = features::fpfh(flat, kWithin, context);
  const Eigen::MatrixXf full = features::pfh(flat, kWithin, context);
  for (Index i = 0; i < flat.size(); ++i) {
    for (const Index middle : {5, 16, 27}) CHECK(fast(middle, i) == Approx(100.0));
    CHECK(fast.col(i).sum() == Approx(300.0));
    CHECK(full(62, i) == Approx(100.0));
    CHECK(full.col(i).sum() == Approx(100.0));
  }
}

TEST_CASE("a known angle between two normals falls into the bins that thesis 3.4 gives") {
  Points points(3, 2);
  points << 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 0.0F;
  Points normals(3, 2);
  normals << 0.0F, 0.8F, 0.0F, 0.0F, 1.0F, 0.6F;
  PlainContext context;
  const Eigen::MatrixXf full = features::pfh(with_normals(points, normals), {{}, 2.0}, context);
  // The second normal is nearer to the line and carries the frame, the line turned round. Then
  // theta = atan2(0.8, 0.6), alpha = 0 and phi = -0.8: shares 0.648, 0.5 and 0.1 of five bins.
  CHECK(full(3 + 5 * (2 + 5 * 0), 0) == Approx(100.0));
  CHECK(full(3 + 5 * (2 + 5 * 0), 1) == Approx(100.0));
}

TEST_CASE("normals of the other sign give the mirrored histograms") {
  PlainContext context;
  const Cloud cloud = hills();
  const Points turned = -cloud.normals();
  const Cloud other = cloud.with(velum::column::kNormals, Column(turned));
  CHECK(difference(features::fpfh(other, kWithin, context),
                   features::mirrored_fpfh(features::fpfh(cloud, kWithin, context))) < 1e-3);
  CHECK(difference(features::pfh(other, kWithin, context),
                   features::mirrored_pfh(features::pfh(cloud, kWithin, context))) < 1e-3);
}

TEST_CASE("neither a motion nor an origin far away changes the histograms") {
  PlainContext context;
  const Eigen::MatrixXf here = features::fpfh(hills(), kWithin, context);
  CHECK(here == features::fpfh(hills({4e5, 5e6, 1e7}), kWithin, context));
  velum::Pose pose = velum::Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  CHECK(difference(here, features::fpfh(hills().transformed(pose), kWithin, context)) < 5e-3);
}

TEST_CASE("histograms are the same with one thread and with two") {
  PlainContext one(1);
  PlainContext two(2);
  CHECK(features::fpfh(hills(), kWithin, one) == features::fpfh(hills(), kWithin, two));
}

TEST_CASE("nothing, one point, and points in one place have empty histograms") {
  PlainContext context;
  CHECK(features::fpfh(row_of(0, Eigen::Vector3f::UnitZ()), kWithin, context).cols() == 0);
  CHECK(features::fpfh(row_of(1, Eigen::Vector3f::UnitZ()), kWithin, context).isZero());
  CHECK(features::pfh(row_of(1, Eigen::Vector3f::UnitZ()), kWithin, context).isZero());
  const Cloud same =
      with_normals(Points::Ones(3, 9), Eigen::Vector3f::UnitZ().replicate(1, 9).eval());
  CHECK(features::fpfh(same, kWithin, context).isZero());
  CHECK(features::pfh(same, kWithin, context).isZero());
}

TEST_CASE("normals along the line of the points, and those that are none, take no part") {
  PlainContext context;
  CHECK(features::fpfh(row_of(6, Eigen::Vector3f::UnitX()), kWithin, context).isZero());
  CHECK(features::fpfh(row_of(6, {kNaN, kNaN, kNaN}), kWithin, context).isZero());
  CHECK(features::pfh(row_of(6, {kNaN, 0.0F, 1.0F}), kWithin, context).isZero());
  CHECK(features::fpfh(row_of(6, Eigen::Vector3f::Zero()), kWithin, context).isZero());
}

TEST_CASE("the nearest features are those that a plain search finds, first those of low number") {
  PlainContext context(2);
  velum::Random random(5);
  const auto made = [&](Index count) {
    Eigen::MatrixXf set(4, count);
    for (Index i = 0; i < set.size(); ++i) set.data()[i] = static_cast<float>(random.below(5));
    return set;
  };
  const Eigen::MatrixXf queries = made(150);
  const Eigen::MatrixXf set = made(90);
  const auto found = features::nearest_features(queries, set, 3, context);
  for (Index q = 0; q < queries.cols(); ++q) {
    std::vector<std::pair<float, int>> all;
    for (Index s = 0; s < set.cols(); ++s)
      all.emplace_back((queries.col(q) - set.col(s)).squaredNorm(), static_cast<int>(s));
    std::sort(all.begin(), all.end());
    for (Index k = 0; k < 3; ++k) {
      CHECK(found.index(k, q) == all[static_cast<std::size_t>(k)].second);
      CHECK(found.distance2(k, q) == Approx(all[static_cast<std::size_t>(k)].first).margin(1e-4));
    }
  }
}

TEST_CASE("where a set has too few features the rest is left open") {
  PlainContext context;
  const Eigen::MatrixXf queries = Eigen::MatrixXf::Ones(3, 2);
  const auto found = features::nearest_features(queries, queries.leftCols(1), 2, context);
  CHECK(found.index(0, 1) == 0);
  CHECK(found.index(1, 1) == -1);
  CHECK(std::isinf(found.distance2(1, 1)));
  const auto none = features::nearest_features(queries, Eigen::MatrixXf(3, 0), 2, context);
  CHECK(none.index.maxCoeff() == -1);
}
