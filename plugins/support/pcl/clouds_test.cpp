// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "pcl/clouds.hpp"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <catch2/catch.hpp>
#include <velum/error.hpp>

using velum::Cloud;
using velum::Column;
using velum::Points;

namespace {

Cloud two_points() {
  Points positions(3, 2);
  positions << 1, 4, 2, 5, 3, 6;
  Points normals(3, 2);
  normals << 0, 1, 0, 0, 1, 0;
  return Cloud(positions, Eigen::Vector3d(4e5, 5e6, 0))
      .with("normals", Column(normals))
      .with("curvature", Column(Eigen::VectorXf(Eigen::Vector2f(0.25F, 0.5F))));
}

}  // namespace

TEST_CASE("clouds go to PCL and come back, relative to their origin") {
  const Cloud cloud = two_points();
  const auto oriented = velum::with_pcl::oriented(cloud);
  CHECK(velum::with_pcl::positions_of(*oriented) == cloud.positions());
  CHECK(velum::with_pcl::normals_of(*oriented) == cloud.normals());
  CHECK(velum::with_pcl::curvature_of(*oriented) == cloud.curvature());
  CHECK(velum::with_pcl::positions_of(*velum::with_pcl::positions(cloud)) == cloud.positions());
  CHECK(velum::with_pcl::normals(cloud)->at(1).normal_x == 1.0F);
}

TEST_CASE("empty clouds are clouds") {
  CHECK(velum::with_pcl::positions(Cloud())->empty());
  CHECK_THROWS_AS(velum::with_pcl::normals(two_points().without("normals")), velum::Error);
}

TEST_CASE("what PCL throws is an error of the stage, others pass") {
  const auto quietly = [](const auto& call) { velum::with_pcl::quietly("PCL's sums", call); };
  CHECK_THROWS_WITH(quietly([] { throw std::runtime_error("one and one"); }),
                    "PCL's sums failed: one and one");
  CHECK_THROWS_AS(quietly([] { throw velum::Cancelled(); }), velum::Cancelled);
  CHECK_THROWS_AS(quietly([] { throw std::bad_alloc(); }), std::bad_alloc);
}
