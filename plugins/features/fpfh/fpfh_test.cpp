// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <pcl/features/fpfh.h>
#include <pcl/search/kdtree.h>

#include <catch2/catch.hpp>
#include <velum/testing.hpp>

#include "pcl/clouds.hpp"

using velum::Cloud;
using velum::Column;
using velum::Index;
using velum::Points;
using velum::test::Stage;

namespace {

/// Hills over 1 m with their exact normals.
Cloud hills(Index count) {
  velum::Random random(6);
  Points points(3, count);
  Points normals(3, count);
  for (Index i = 0; i < count; ++i) {
    const double x = random.uniform();
    const double y = random.uniform();
    points.col(i) << static_cast<float>(x), static_cast<float>(y),
        static_cast<float>(0.1 * std::sin(7.0 * x) * std::cos(5.0 * y));
    normals.col(i) = Eigen::Vector3d(-0.7 * std::cos(7.0 * x) * std::cos(5.0 * y),
                                     0.5 * std::sin(7.0 * x) * std::sin(5.0 * y), 1.0)
                         .normalized()
                         .cast<float>();
  }
  return Cloud(std::move(points)).with("normals", Column(std::move(normals)));
}

Eigen::MatrixXf fpfh(const Cloud& cloud, double radius) {
  return Stage("features.fpfh").set("radius", radius).run(cloud).cloud().column("fpfh").as<float>();
}

}  // namespace

TEST_CASE("they are PCL's, but for values that rounding puts into the next bin") {
  const Cloud cloud = hills(1500);
  const Eigen::MatrixXf ours = fpfh(cloud, 0.08);
  pcl::FPFHEstimation<pcl::PointXYZ, pcl::Normal, pcl::FPFHSignature33> estimation;
  estimation.setInputCloud(velum::with_pcl::positions(cloud));
  estimation.setInputNormals(velum::with_pcl::normals(cloud));
  estimation.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  estimation.setRadiusSearch(0.08);
  pcl::PointCloud<pcl::FPFHSignature33> theirs;
  estimation.compute(theirs);
  REQUIRE(ours.rows() == 33);
  REQUIRE(static_cast<Index>(theirs.size()) == ours.cols());
  double difference = 0.0;
  for (Index i = 0; i < ours.cols(); ++i)
    for (Index b = 0; b < 33; ++b)
      difference += std::abs(ours(b, i) - theirs[static_cast<std::size_t>(i)].histogram[b]);
  // Each histogram sums to 300.
  CHECK(difference / static_cast<double>(ours.cols()) < 0.1);
}

TEST_CASE("each of the three parts sums to 100") {
  const Eigen::MatrixXf found = fpfh(hills(800), 0.1);
  for (Index part = 0; part < 3; ++part) {
    const Eigen::VectorXf sums = found.middleRows(11 * part, 11).colwise().sum().transpose();
    CHECK(sums.minCoeff() == Approx(100.0).epsilon(1e-4));
    CHECK(sums.maxCoeff() == Approx(100.0).epsilon(1e-4));
  }
}

TEST_CASE("on a plane all angles are right or none: one bin each") {
  Points points(3, 400);
  for (Index i = 0; i < 400; ++i)
    points.col(i) << static_cast<float>(i % 20), static_cast<float>(i / 20), 0.0F;
  const Points normals = Eigen::Vector3f::UnitZ().replicate(1, 400);
  const Cloud plane = Cloud(points).with("normals", Column(Points(normals)));
  const Eigen::MatrixXf found = fpfh(plane, 2.5);
  for (const Index middle : {5, 16, 27}) CHECK(found.row(middle).minCoeff() > 99.9F);
}

TEST_CASE("they do not change when the cloud is moved") {
  const Cloud cloud = hills(800);
  velum::Pose pose = velum::Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  pose.translation() << 3, -2, 1;
  const double change =
      (fpfh(cloud, 0.1) - fpfh(cloud.transformed(pose), 0.1)).cwiseAbs().colwise().sum().mean();
  CHECK(change < 1.0);
}

TEST_CASE("the number of neighbours can be limited, and both limits hold") {
  const Cloud cloud = hills(800);
  const auto with = [&](const char* neighbours, const char* radius) {
    const auto outcome =
        Stage("features.fpfh").set("neighbours", neighbours).set("radius", radius).run(cloud);
    return Eigen::MatrixXf(outcome.cloud().column("fpfh").as<float>());
  };
  CHECK(with("800", "0.1") == fpfh(cloud, 0.1));
  CHECK(with("10", "0.1") != fpfh(cloud, 0.1));
}

TEST_CASE("a point without neighbours has an empty histogram and is counted") {
  Points points = Points::Zero(3, 3);
  points(0, 1) = 0.1F;
  points(0, 2) = 9.0F;
  const Cloud cloud =
      Cloud(points).with("normals", Column(Points(Eigen::Vector3f::UnitZ().replicate(1, 3))));
  const auto outcome = Stage("features.fpfh").set("radius", 0.5).run(cloud);
  CHECK(outcome.measure("empty") == 1.0);
  CHECK(outcome.cloud().column("fpfh").as<float>().col(2).isZero());
}

TEST_CASE("normals are needed, and sound parameters") {
  CHECK_THROWS_WITH(Stage("features.fpfh").run(Cloud(Points::Random(3, 50))),
                    Catch::Contains("normals"));
  CHECK_THROWS_AS(Stage("features.fpfh").set("neighbours", "1"), velum::Error);
  CHECK_THROWS_AS(Stage("features.fpfh").set("radius", "0"), velum::Error);
}

TEST_CASE("fpfh keeps to the promises of every stage") {
  for (const auto& fault : velum::test::conformance("features.fpfh")) FAIL_CHECK(fault);
}
