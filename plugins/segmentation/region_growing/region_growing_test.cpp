// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "shapes/test_segmentation.hpp"

using velum::Cloud;
using velum::Clusters;
using velum::Index;
using velum::Points;
using velum::test::Outcome;
using velum::test::Stage;
using velum::test::with_normals;

namespace {

// A patch of side×side points 10 mm apart that starts at `corner` and spans the axes u and v.
Points patch(Index side, const Eigen::Vector3f& corner, const Eigen::Vector3f& u,
             const Eigen::Vector3f& v) {
  Points points(3, side * side);
  for (Index i = 0; i < side; ++i)
    for (Index j = 0; j < side; ++j)
      points.col(i * side + j) =
          corner + 0.01F * (static_cast<float>(i) * u + static_cast<float>(j) * v);
  return points;
}

Cloud join(const std::vector<Points>& parts) {
  std::vector<Cloud> clouds;
  for (const Points& part : parts) clouds.emplace_back(part);
  return with_normals(velum::merge(clouds));
}

// Three walls of 30×30, 20×20 and 10×10 points: two meet at a right angle, one stands apart.
Cloud room() {
  return join({patch(20, {0, 1, 0}, Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitZ()),
               patch(30, {2, 1, 0}, Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitY()),
               patch(10, {0, 1.01F, -0.01F}, Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitY())});
}

Stage stage() {
  Stage made("segmentation.region_growing");
  made.set("neighbours", "9").set("min_size", "20");
  return made;
}

const Clusters& clusters(const Outcome& outcome) {
  return outcome.get<Clusters>();
}

std::int64_t points_in(const Clusters& found, std::size_t row) {
  return static_cast<std::int64_t>(found.kinds.number(row, "points"));
}

}  // namespace

TEST_CASE("walls are told apart, the largest first") {
  const Outcome outcome = stage().run(room());
  const Clusters& found = clusters(outcome);
  REQUIRE(found.kinds.size() == 3);
  CHECK(points_in(found, 0) == 900);
  CHECK(points_in(found, 1) >= 340);
  CHECK(points_in(found, 2) >= 60);
  CHECK(found.label()[450] == 0);
  CHECK(std::abs(found.kinds.number(0, "normal_z")) == Approx(1.0));
}

TEST_CASE("what every segmentation promises") {
  velum::test::keeps_promises_with_normals(stage());
}

TEST_CASE("labels and the table of clusters agree") {
  velum::test::labels_agree(stage().run(room()));
}

TEST_CASE("the table describes each cluster") {
  const Cloud wall =
      join({patch(30, {1, 2, 3}, Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitZ())});
  const Outcome outcome = stage().run(wall);
  const velum::Table& kinds = clusters(outcome).kinds;
  REQUIRE(kinds.size() == 1);
  CHECK(kinds.number(0, "centre_x") == Approx(1.145));
  CHECK(kinds.number(0, "centre_y") == Approx(2.0));
  CHECK(kinds.number(0, "area") == Approx(0.09).epsilon(0.25));
  CHECK(kinds.number(0, "depth") == Approx(0.0).margin(1e-5));
  CHECK(kinds.number(0, "flatness") == Approx(0.0).margin(1e-5));
  CHECK(kinds.number(0, "length") > 0.28);
}

TEST_CASE("a smoothly curved sheet is one region, though its ends stand square to each other") {
  Points quarter(3, 80 * 40);
  for (Index i = 0; i < 80; ++i)
    for (Index j = 0; j < 40; ++j) {
      const double angle = 1.5707963 * static_cast<double>(i) / 79.0;
      quarter.col(i * 40 + j) =
          Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.02 * static_cast<double>(j))
              .cast<float>();
    }
  const Outcome outcome = stage().run(with_normals(Cloud(std::move(quarter))));
  REQUIRE(clusters(outcome).kinds.size() == 1);
  CHECK(points_in(clusters(outcome), 0) == 3200);
}

TEST_CASE("a sheet with normals to both sides is one region") {
  Cloud wall = join({patch(30, {0, 1, 0}, Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitZ())});
  Points normals(wall.normals());
  for (Index i = 0; i < normals.cols(); i += 2) normals.col(i) *= -1.0F;
  wall = wall.with("normals", velum::Column(std::move(normals)));
  CHECK(points_in(clusters(stage().run(wall)), 0) == 900);
}

TEST_CASE("a smaller angle and a lower curvature threshold divide more") {
  Points bowl(3, 60 * 60);
  velum::Random random(5);
  for (Index i = 0; i < bowl.cols(); ++i) {
    const double x = static_cast<double>(i % 60) * 0.01, y = static_cast<double>(i / 60) * 0.01;
    bowl.col(i) = Eigen::Vector3d(x, y, 0.0004 * random.gaussian() + x * x).cast<float>();
  }
  const Cloud cloud = with_normals(Cloud(std::move(bowl)));
  const double wide = stage().set("smoothness", "20 deg").run(cloud).measure("assigned");
  const double narrow = stage().set("smoothness", "1 deg").run(cloud).measure("assigned");
  const double strict = stage().set("curvature", "0.0001").run(cloud).measure("assigned");
  CHECK(wide > 0.99);
  CHECK(narrow < wide);
  CHECK(strict < wide);
}

TEST_CASE("regions out of the allowed sizes are refused, and what they took stays taken") {
  const Outcome outcome = stage().set("max_size", "800").run(room());
  CHECK(clusters(outcome).label()[450] == -1);
  CHECK(clusters(outcome).kinds.size() == 2);
  REQUIRE(outcome.warnings.size() == 1);
  CHECK(outcome.warnings.front().find("max_size") != std::string::npos);
  CHECK_THROWS_AS(stage().set("max_size", "10").run(room()), velum::Error);
}

TEST_CASE("thresholds that cannot work are warned of") {
  const Outcome off = stage().set("curvature", "0.9").run(room());
  REQUIRE(off.warnings.size() == 1);
  CHECK(off.warnings.front().find("1/3") != std::string::npos);
  const Outcome none = stage().set("min_size", "5000").run(room());
  REQUIRE(none.warnings.size() == 1);
  CHECK(none.warnings.front().find("900 points") != std::string::npos);
  CHECK(clusters(none).kinds.empty());
}

TEST_CASE("the order of the points does not matter to what belongs together") {
  const Cloud cloud = room();
  std::vector<std::int32_t> backwards(static_cast<std::size_t>(cloud.size()));
  for (std::size_t i = 0; i < backwards.size(); ++i)
    backwards[i] = static_cast<std::int32_t>(backwards.size() - 1 - i);
  const Outcome forth = stage().run(cloud);
  const Outcome back = stage().run(cloud.select(backwards));
  CHECK(points_in(clusters(forth), 0) == points_in(clusters(back), 0));
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("segmentation.region_growing"))
    FAIL_CHECK(fault);
}
