// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <numbers>
#include <velum/testing.hpp>

#include "geometry/motion.hpp"
#include "registration/test_room.hpp"

using velum::Cloud;
using velum::Pose;
using velum::test::Outcome;
using velum::test::Room;
using velum::test::Stage;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

const std::string kScene = VELUM_SOURCE_DIR "/graphs/scenes/wind_tunnel.toml";

Cloud scan(const std::string& scanner, double step, std::uint64_t seed) {
  return Stage("devices.simulator")
      .set("scene", kScene)
      .set("scanner", scanner)
      .set("beam_step", std::to_string(step))
      .set("tilt_step", std::to_string(step))
      .seed(seed)
      .run()
      .cloud();
}

/// Mainsail scanner's frame to gennaker scanner's.
Pose scene_truth() {
  return Stage("devices.truth")
      .set("scene", kScene)
      .set("scanner", "mainsail")
      .set("frame", "gennaker")
      .run()
      .get<velum::Transform>()
      .matrix;
}

struct Pair {
  Cloud source;
  Cloud target;
  Pose truth;
  Eigen::Vector3d middle;  ///< of what matters, in the source's frame
};

/// Both scans with the noise numbered `noise`.
const Pair& tunnel(double step, std::uint64_t noise = 1) {
  static std::map<std::pair<double, std::uint64_t>, Pair> made;
  const auto key = std::pair(step, noise);
  if (made.count(key) == 0)
    made.emplace(key, Pair{scan("mainsail", step, 2 * noise), scan("gennaker", step, 2 * noise + 1),
                           scene_truth(), Eigen::Vector3d(2.5, 0.0, 0.0)});
  return made.at(key);
}

/// Turns and shifts the source any way, registers, and compares.
void register_turned(const Pair& pair, std::uint64_t seed) {
  velum::Random random(seed);
  const Pose frame = velum::test::random_pose(random, 5.0);
  const Outcome outcome =
      Stage("registration.planes").run(pair.source.transformed(frame), pair.target);
  const auto miss = velum::geometry::difference(outcome.get<velum::Transform>().matrix,
                                                pair.truth * frame.inverse(), frame * pair.middle);
  INFO("seed " << seed << ": " << miss.rotation / kDegree << " deg, " << 1e3 * miss.translation
               << " mm, evidence " << outcome.measure("evidence"));
  CHECK(miss.rotation < 0.05 * kDegree);
  CHECK(miss.translation < 2e-3);
}

Room empty_room() {
  Room room;
  room.low = {-4.0, -3.0, 0.0};
  room.high = {4.0, 3.0, 3.0};
  return room;
}

const Pose kFirst = velum::test::looking({-2.0, 1.0, 1.0}, {0.0, 0.0, 1.5});
const Pose kSecond = velum::test::looking({2.0, 1.5, 1.2}, {0.0, 0.0, 1.5});

}  // namespace

TEST_CASE("the wind tunnel's scans come together from any orientation") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) register_turned(tunnel(0.5, seed % 4), seed);
}

TEST_CASE("the wind tunnel's scans come together from a hundred orientations", "[.][long]") {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) register_turned(tunnel(0.25, seed % 10), seed);
}

TEST_CASE("the cloud given back lies in the target's frame, columns and sensor with it") {
  const Pair& pair = tunnel(0.5);
  const Outcome outcome = Stage("registration.planes").run(pair.source, pair.target);
  REQUIRE(outcome.cloud().size() == pair.source.size());
  CHECK(outcome.cloud().has("label"));
  const Eigen::Vector3d eye = outcome.cloud().sensors().at(0).pose.translation();
  CHECK((eye - pair.truth * pair.source.sensors().at(0).pose.translation()).norm() < 2e-3);
  CHECK(outcome.measure("overlap") > 0.2);
  CHECK(outcome.measure("planes") >= 3);
  CHECK(outcome.measure("deviation_translation") < 2e-3);
  CHECK(static_cast<double>(outcome.get<velum::Table>().size()) == outcome.measure("iterations"));
}

TEST_CASE("a scan against its own moved copy errs by rounding (thesis table 3.23)") {
  const Cloud scan = Room::tunnel(true).scan(kFirst, 0.015, 0.004, 1);
  Pose moved = Pose::Identity();
  moved.linear() =
      Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX()).toRotationMatrix();
  moved.translation().setConstant(1.0);
  const Outcome outcome = Stage("registration.planes").run(scan, scan.transformed(moved));
  const auto miss = velum::geometry::difference(outcome.get<velum::Transform>().matrix, moved);
  CHECK(miss.rotation < 1e-5);
  CHECK(miss.translation < 3e-5);
}

TEST_CASE("an empty rectangular room is refused, and picks settle it") {
  const Cloud source = empty_room().scan(kFirst, 0.02, 0.004, 1);
  const Cloud target = empty_room().scan(kSecond, 0.02, 0.004, 2);
  CHECK_THROWS_WITH(Stage("registration.planes").run(source, target),
                    Catch::Contains("does not tell them apart"));
  // The wall at y = -3 and the floor; a wall turned about the vertical would be another wall.
  const auto row = [](const Eigen::Vector3d& place) {
    const Eigen::Vector3d s = kFirst.inverse() * place;
    const Eigen::Vector3d t = kSecond.inverse() * place;
    const auto text = [](const Eigen::Vector3d& p) {
      return "[" + std::to_string(p.x()) + "," + std::to_string(p.y()) + "," +
             std::to_string(p.z()) + "]";
    };
    return "{source = " + text(s) + ", target = " + text(t) + "},";
  };
  const Outcome outcome =
      Stage("registration.planes")
          .set("picks", "[" + row({0.0, -3.0, 1.5}) + row({0.0, -1.0, 0.0}) + "]")
          .run(source, target);
  const auto miss = velum::geometry::difference(outcome.get<velum::Transform>().matrix,
                                                kSecond.inverse() * kFirst, {2.0, 0.0, 0.0});
  CHECK(miss.rotation < 0.05 * kDegree);
  CHECK(miss.translation < 2e-3);
}

TEST_CASE("scans of different rooms are refused") {
  Room other = Room::tunnel(true);
  other.high = {5.0, 6.0, 5.5};
  other.low = {-3.5, -2.0, 0.0};
  CHECK_THROWS_AS(Stage("registration.planes")
                      .run(Room::tunnel(true).scan(kFirst, 0.02, 0.004, 1),
                           other.scan(kSecond, 0.02, 0.004, 2)),
                  velum::Error);
}

TEST_CASE("clouds without two planes are refused, and it says so") {
  velum::Random random(1);
  velum::Points ball(3, 3000);
  velum::Points floor(3, 3000);
  for (velum::Index i = 0; i < 3000; ++i) {
    for (int k = 0; k < 3; ++k) ball(k, i) = static_cast<float>(random.gaussian());
    floor.col(i) << static_cast<float>(random.uniform()), static_cast<float>(random.uniform()),
        1.0F;
  }
  CHECK_THROWS_WITH(Stage("registration.planes").run(Cloud(ball), Cloud(ball)),
                    Catch::Contains("the source shows 0 planes"));
  CHECK_THROWS_WITH(Stage("registration.planes").run(Cloud(floor), Cloud(floor)),
                    Catch::Contains("the source shows 1 plane;"));
}

TEST_CASE("a limit on the deviation that no scan can keep is refused") {
  const Pair& pair = tunnel(0.5);
  CHECK_THROWS_WITH(
      Stage("registration.planes").set("max_deviation", "1e-9 m").run(pair.source, pair.target),
      Catch::Contains("the pose is not fixed"));
}

TEST_CASE("a pick that lies on no plane is refused") {
  const Pair& pair = tunnel(0.5);
  CHECK_THROWS_WITH(Stage("registration.planes")
                        .set("picks", "[{source = [99, 0, 0], target = [0, 0, 0]}]")
                        .run(pair.source, pair.target),
                    Catch::Contains("lies on no plane of the source"));
}

TEST_CASE("one thread and two give the same bytes") {
  const Pair& pair = tunnel(0.5);
  const auto a = Stage("registration.planes").threads(1).run(pair.source, pair.target);
  const auto b = Stage("registration.planes").threads(2).run(pair.source, pair.target);
  CHECK(a.get<velum::Transform>().matrix.matrix() == b.get<velum::Transform>().matrix.matrix());
  CHECK(hash_of(velum::Value(a.cloud())) == hash_of(velum::Value(b.cloud())));
}

TEST_CASE("registering by planes keeps to the promises of every stage") {
  for (const auto& fault : velum::test::conformance("registration.planes")) FAIL_CHECK(fault);
}
