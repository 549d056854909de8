// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "geometry/find_planes.hpp"

#include <catch2/catch.hpp>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "geometry/thinning.hpp"
#include "registration/test_context.hpp"
#include "registration/test_room.hpp"

using namespace velum;
using namespace velum::geometry;

namespace {

const ScenePlane* facing(const ScenePlanes& scene, const Eigen::Vector3d& normal) {
  for (const ScenePlane& plane : scene.planes)
    if (plane.fit.normal.dot(normal) > 0.998) return &plane;
  return nullptr;
}

/// A scan of 3DTK's text form [cm], without the beams that came back from nowhere (32 m).
Cloud nodding_scan(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::vector<Eigen::Vector3f> kept;
  for (std::string line; std::getline(stream, line);) {
    Eigen::Vector3f p;
    const char* at = line.data();
    const char* end = at + line.size();
    for (int k = 0; k < 3; ++k) {
      while (at < end && *at == ' ') ++at;
      at = std::from_chars(at, end, p[k]).ptr;
    }
    if (p.norm() < 3000.0F) kept.push_back(0.01F * p);
  }
  Points points(3, static_cast<Index>(kept.size()));
  for (std::size_t i = 0; i < kept.size(); ++i) points.col(static_cast<Index>(i)) = kept[i];
  return Cloud(points);
}

}  // namespace

TEST_CASE("thinning gives one mean a cell and says which point went where") {
  Points points(3, 4);
  points.row(0) << 0.0F, 0.2F, 1.1F, 5.0F;
  points.bottomRows(2).setZero();
  const Cloud cloud(points);
  const Thinned thinned = thin(cloud.positions(), 1.0);
  REQUIRE(thinned.means.cols() == 3);
  CHECK(thinned.means(0, 0) == Approx(0.1));
  CHECK(thinned.counts == std::vector<std::int32_t>{2, 1, 1});
  CHECK(thinned.cell_of == std::vector<std::int32_t>{0, 0, 1, 2});
  CHECK(thin(Cloud().positions(), 1.0).means.cols() == 0);
  CHECK(cell_for(Cloud(Points(Points::Zero(3, 9))).positions(), 3) == 0.0);
}

TEST_CASE("the six planes of a room, facing the scanner, without what stands in it") {
  const test::Room room = test::Room::tunnel(true);
  const Pose pose = test::looking({-3.0, 1.5, 1.2}, {0.0, 0.0, 1.2});
  const Cloud scan = room.scan(pose, 0.0131, 0.004, 1, 1.5);
  test::PlainContext context;
  const ScenePlanes scene = find_planes(scan, {}, context);
  for (const Eigen::Vector3d& inward :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(0, 1, 0),
        Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(-1, 0, 0)}) {
    const ScenePlane* plane = facing(scene, pose.linear().transpose() * inward);
    REQUIRE(plane != nullptr);
    const Eigen::Vector3d normal = pose.linear() * plane->fit.normal;
    CHECK(normal.dot(inward) > std::cos(2e-4));
    const Eigen::Vector3d wall =
        inward.cwiseMax(0).cwiseProduct(room.low) - inward.cwiseMin(0).cwiseProduct(room.high);
    const double expected = inward.cwiseAbs().dot(wall) * inward.sum();
    CHECK(normal.dot(pose * plane->fit.centroid) == Approx(expected).margin(5e-4));
    CHECK(plane->fit.rms() < 0.0045);
  }
  Index rest = 0;
  Index misplaced = 0;
  for (Index i = 0; i < scan.size(); ++i) {
    if (scene.plane_of[static_cast<std::size_t>(i)] >= 0) continue;
    const Eigen::Vector3d p = pose * scan.positions().col(i).cast<double>();
    ++rest;
    misplaced += ((p - room.low).minCoeff() < 0.02 || (room.high - p).minCoeff() < 0.02) ? 1 : 0;
  }
  CHECK(rest > 500);
  CHECK(misplaced < rest / 10);
}

TEST_CASE("no planes in what has none, and nothing breaks on little") {
  test::PlainContext context;
  Random random(5);
  Points ball(3, 5000);
  for (Index i = 0; i < ball.cols(); ++i)
    ball.col(i) = Eigen::Vector3f(static_cast<float>(random.gaussian()),
                                  static_cast<float>(random.gaussian()),
                                  static_cast<float>(random.gaussian()))
                      .normalized();
  CHECK(find_planes(Cloud(ball), {}, context).planes.empty());
  for (const Index n : {0, 1, 2, 3}) {
    const Cloud few(Points(Points::Random(3, n)));
    const ScenePlanes scene = find_planes(few, {}, context);
    CHECK(scene.planes.empty());
    CHECK(scene.plane_of.size() == static_cast<std::size_t>(n));
  }
  CHECK(find_planes(Cloud(Points(Points::Ones(3, 100))), {}, context).planes.empty());
}

TEST_CASE("walls, floor and ceiling of the nodding scans") {
  const char* shared = std::getenv("VELUM_SHARED");
  const std::filesystem::path folder =
      std::filesystem::path(shared != nullptr ? shared : "") / "data/registration/sick_nodding";
  if (!std::filesystem::exists(folder)) {
    WARN("skipped: no shared data");
    return;
  }
  test::PlainContext context;
  for (const char* name : {"scan000.3d", "scan001.3d"}) {
    const ScenePlanes scene = find_planes(nodding_scan(folder / name), {}, context);
    int walls = 0;
    bool floor = false;
    bool ceiling = false;
    for (const ScenePlane& plane : scene.planes) {
      const Eigen::Vector3d n = plane.fit.normal;
      INFO(name << " " << n.transpose() << " at " << plane.fit.offset() << ", " << plane.points
                << " points, rms " << plane.fit.rms());
      CHECK(plane.fit.rms() < 0.05);
      // The floor is about 0.35 m on one side of the scanner, the ceiling 2.05 m on the other.
      if (std::abs(n.y()) > 0.98) {
        floor = floor || (n.y() > 0.0 && std::abs(plane.fit.offset() + 0.35) < 0.1);
        ceiling = ceiling || (n.y() < 0.0 && std::abs(plane.fit.offset() + 2.05) < 0.15);
      }
      walls += std::abs(n.y()) < 0.1 ? 1 : 0;
    }
    CHECK(floor);
    CHECK(ceiling);
    CHECK(walls >= 2);
  }
}
