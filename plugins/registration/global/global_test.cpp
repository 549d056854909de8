// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <velum/testing.hpp>

#include "geometry/motion.hpp"
#include "registration/test_room.hpp"

using velum::Cloud;
using velum::Index;
using velum::Points;
using velum::Pose;
using velum::test::Outcome;
using velum::test::Stage;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;
const std::string kScene = VELUM_SOURCE_DIR "/graphs/scenes/wind_tunnel.toml";

/// The thesis's four shapes (figure 3.13) over a floor of 60, those with `low` <= x <= `high`: as
/// many points on each as in its table 3.24.
Cloud shapes(std::uint64_t seed, double low = -99.0, double high = 99.0) {
  velum::Random random(seed);
  std::vector<Eigen::Vector3f> found;
  const auto put = [&](double x, double y, double z) {
    if (x >= low && x <= high) found.push_back(Eigen::Vector3d(x, y, z).cast<float>());
  };
  for (int i = 0; i < 3600; ++i) {
    const double x = random.uniform(-10.0, 50.0);
    put(x, random.uniform(-10.0, 50.0), 0.0);
  }
  for (int i = 0; i < 8100; ++i) {
    const double z = random.uniform(-1.0, 1.0);
    const double a = random.uniform(0.0, 2.0 * kPi);
    const double r = std::sqrt(1.0 - z * z);
    put(10.0 + 8.0 * r * std::cos(a), 8.0 + 8.0 * r * std::sin(a), 12.0 + 8.0 * z);
  }
  for (int i = 0; i < 3600; ++i) {
    const double a = random.uniform(0.0, 2.0 * kPi);
    put(35.0 + 5.0 * std::cos(a), 12.0 + 5.0 * std::sin(a), random.uniform(2.0, 22.0));
  }
  for (int i = 0; i < 5611; ++i) {
    const double a = random.uniform(0.0, 2.0 * kPi);
    const double h = std::sqrt(random.uniform());
    put(22.0 + 7.0 * h * std::cos(a), 36.0 + 7.0 * h * std::sin(a), 20.0 - 16.0 * h);
  }
  Points points(3, static_cast<Index>(found.size()));
  for (std::size_t i = 0; i < found.size(); ++i) points.col(static_cast<Index>(i)) = found[i];
  return Cloud(std::move(points));
}

/// A pair with its truth (source to target) and what counts as right; `reach` is how far [m] the
/// source is thrown.
struct Pair {
  Cloud source;
  Cloud target;
  Pose truth = Pose::Identity();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double rotation = 0.5 * kDegree;
  double translation = 0.0;
  double reach = 1.0;
};

Pair prepared(Pair pair) {
  pair.target = Stage("features.normals").run(pair.target).cloud();
  pair.middle = pair.source.origin() + pair.source.positions().cast<double>().rowwise().mean();
  return pair;
}

struct Trial {
  bool refused = false;
  bool right = false;
  std::string text;
};

/// `global` from a random pose, then ICP from what it found.
Trial trial(const Pair& pair, const Pose& frame) {
  Trial result;
  const Cloud source = pair.source.transformed(frame);
  try {
    const Outcome start = Stage("registration.global").run(source, pair.target);
    // By planes the pose is settled on all points already.
    velum::Transform found = start.get<velum::Transform>();
    if (start.measure("by_planes") == 0.0)
      found = Stage("registration.icp")
                  .set("metric", "point_to_plane")
                  .set("max_distance", 0.7 * start.measure("resolution"))
                  .set("keep", "0.9")
                  .set("relative_change", "1e-5")
                  .set("iterations", "60")
                  .run(source, pair.target, found)
                  .get<velum::Transform>();
    const auto miss = velum::geometry::difference(found.matrix, pair.truth * frame.inverse(),
                                                  frame * pair.middle);
    result.right = miss.rotation < pair.rotation && miss.translation < pair.translation;
    result.text = std::to_string(miss.rotation / kDegree) + " deg, " +
                  std::to_string(1e3 * miss.translation) + " mm";
  } catch (const velum::Error& error) {
    result.refused = true;
    result.text = error.what();
  }
  return result;
}

Pose random_frame(const Pair& pair, std::uint64_t seed) {
  velum::Random random(seed);
  return velum::test::random_pose(random, pair.reach);
}

struct Tally {
  int right = 0;
  int wrong = 0;
};

Tally tally(const Pair& pair, std::uint64_t trials) {
  Tally count;
  for (std::uint64_t seed = 1; seed <= trials; ++seed) {
    const Trial one = trial(pair, random_frame(pair, seed));
    count.right += one.right ? 1 : 0;
    count.wrong += !one.right && !one.refused ? 1 : 0;
    if (!one.right) WARN("start " << seed << ": " << one.text);
  }
  return count;
}

Pair whole() {
  return prepared({shapes(1), shapes(1), Pose::Identity(), {}, 0.05 * kDegree, 0.01, 60.0});
}

/// Tables 3.17 and 3.21: a part of the scene against all of it.
Pair part() {
  return prepared(
      {shapes(1, -99.0, 23.0), shapes(1), Pose::Identity(), {}, 0.05 * kDegree, 0.01, 200.0});
}

/// Two parts, each sampled by itself, that share the strip from 16 to 29: under half of the
/// source's points.
Pair parts() {
  return prepared({shapes(2, -99.0, 21.0),
                   shapes(1, 8.0, 99.0),
                   Pose::Identity(),
                   {},
                   0.2 * kDegree,
                   0.05,
                   60.0});
}

std::filesystem::path shared(const char* below) {
  const char* folder = std::getenv("VELUM_SHARED");
  const auto path = std::filesystem::path(folder != nullptr ? folder : "") / below;
  return std::filesystem::exists(path) ? path : std::filesystem::path();
}

Cloud read(const std::filesystem::path& file) {
  return Stage("io.read_cloud").set("file", file.string()).set("units", "m").run().cloud();
}

Pose pose_of(const nlohmann::json& rows) {
  Pose pose = Pose::Identity();
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 4; ++c)
      pose.matrix()(static_cast<Index>(r), static_cast<Index>(c)) = rows[r][c];
  pose.linear() = velum::geometry::orthonormal(pose.linear());
  return pose;
}

std::optional<Pair> bunny(const std::string& target, const std::string& source) {
  const auto folder = shared("data/registration/bunny");
  if (folder.empty()) return {};
  const auto known =
      nlohmann::json::parse(std::ifstream(folder / "truth.json")).at("world_from_scan");
  return prepared({read(folder / ("bun" + source + ".ply")),
                   read(folder / ("bun" + target + ".ply")),
                   pose_of(known.at("bun" + target)).inverse() * pose_of(known.at("bun" + source)),
                   {},
                   0.5 * kDegree,
                   0.5e-3,
                   0.3});
}

std::optional<Pair> street() {
  const auto folder = shared("data/registration/small_gicp");
  if (folder.empty()) return {};
  std::ifstream file(folder / "T_target_source.txt");
  Pose truth = Pose::Identity();
  for (int i = 0; i < 16; ++i) file >> truth.matrix()(i / 4, i % 4);
  return prepared({read(folder / "source.ply"),
                   read(folder / "target.ply"),
                   truth,
                   {},
                   0.5 * kDegree,
                   0.1,
                   30.0});
}

/// Fragments 0 and 1 of 3DMatch's kitchen. The pose that 3DMatch gives for them puts 5 % of the
/// second one's points within 5 cm of the first, for the copy at hand is in another frame; this one
/// puts 79 % there and was settled by ICP.
std::optional<Pair> kitchen() {
  const auto folder = shared("data/registration/redkitchen");
  if (folder.empty()) return {};
  Pose truth = Pose::Identity();
  truth.matrix() << 0.9793, -0.0071, -0.2023, -0.0352,  //
      0.1573, 0.6555, 0.7387, -1.4479,                  //
      0.1274, -0.7552, 0.6430, 0.5458,                  //
      0.0, 0.0, 0.0, 1.0;
  truth.linear() = velum::geometry::orthonormal(truth.linear());
  return prepared({read(folder / "cloud_bin_1.ply"),
                   read(folder / "cloud_bin_0.ply"),
                   truth,
                   {},
                   3.0 * kDegree,
                   0.15,
                   3.0});
}

Cloud scan(const std::string& scanner, std::uint64_t seed) {
  return Stage("devices.simulator")
      .set("scene", kScene)
      .set("scanner", scanner)
      .set("beam_step", "0.5")
      .set("tilt_step", "0.5")
      .seed(seed)
      .run()
      .cloud();
}

Pair tunnel() {
  Pair pair = prepared({scan("mainsail", 2),
                        scan("gennaker", 3),
                        Stage("devices.truth")
                            .set("scene", kScene)
                            .set("scanner", "mainsail")
                            .set("frame", "gennaker")
                            .run()
                            .get<velum::Transform>()
                            .matrix,
                        {},
                        0.05 * kDegree,
                        2e-3,
                        5.0});
  pair.middle = {2.5, 0.0, 0.0};
  return pair;
}

void all_right(const std::optional<Pair>& pair, std::uint64_t trials) {
  if (!pair) {
    WARN("skipped: no shared data");
    return;
  }
  const Tally count = tally(*pair, trials);
  CHECK(count.right >= static_cast<int>(std::ceil(0.99 * static_cast<double>(trials))));
  CHECK(count.wrong == 0);
}

}  // namespace

TEST_CASE("120 degrees about Z and an offset of (30, 20), which defeats ICP (thesis table 3.11)") {
  const Pair pair = whole();
  Pose frame = Pose::Identity();
  frame.linear() = Eigen::AngleAxisd(120.0 * kDegree, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  frame.translation() << 30.0, 20.0, 0.0;
  const Trial one = trial(pair, frame);
  INFO(one.text);
  CHECK(one.right);
}

TEST_CASE("a part of the scene, far away (thesis table 3.21)") {
  all_right(part(), 2);
}

TEST_CASE("two parts that were sampled apart are registered or refused, never put wrong") {
  CHECK(tally(parts(), 4).wrong == 0);
}

TEST_CASE("bunny scans from any orientation") {
  for (const auto& [target, source] :
       {std::pair("000", "045"), std::pair("000", "090"), std::pair("045", "090")})
    all_right(bunny(target, source), 1);
}

TEST_CASE("a street and a kitchen from any orientation") {
  all_right(street(), 1);
  all_right(kitchen(), 1);
}

TEST_CASE("the wind tunnel from any orientation, though it fits itself when turned") {
  all_right(tunnel(), 3);
}

TEST_CASE("without its planes the tunnel is refused, not turned the wrong way") {
  const Pair pair = tunnel();
  CHECK_THROWS_AS(Stage("registration.global")
                      .set("planes", "false")
                      .run(pair.source.transformed(random_frame(pair, 1)), pair.target),
                  velum::Error);
}

TEST_CASE("clouds that share nothing are refused") {
  const Cloud target = shapes(1, 24.0);
  const Cloud source = shapes(2, -99.0, 23.0);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    velum::Random random(seed);
    CHECK_THROWS_AS(Stage("registration.global")
                        .run(source.transformed(velum::test::random_pose(random, 60.0)), target),
                    velum::Error);
  }
}

TEST_CASE("what fixes no pose is refused") {
  velum::Random random(1);
  const auto made = [&](Index count, const auto& point) {
    Points points(3, count);
    for (Index i = 0; i < count; ++i) points.col(i) = point(i).template cast<float>();
    return Cloud(std::move(points));
  };
  const auto ball = [&](Index) {
    return Eigen::Vector3d(random.gaussian(), random.gaussian(), random.gaussian()).normalized();
  };
  const auto floor = [&](Index) {
    const double x = random.uniform();
    return Eigen::Vector3d(x, random.uniform(), 0.0);
  };
  const auto box = [&](Index i) {
    Eigen::Vector3d p(random.uniform(), random.uniform(), random.uniform());
    p[i % 3] = i % 2 == 0 ? 0.0 : 1.0;
    return p;
  };
  CHECK_THROWS_AS(Stage("registration.global").run(made(5000, ball), made(5000, ball)),
                  velum::Error);
  CHECK_THROWS_AS(Stage("registration.global").run(made(5000, floor), made(5000, floor)),
                  velum::Error);
  CHECK_THROWS_AS(Stage("registration.global").run(made(6000, box), made(6000, box)), velum::Error);
}

TEST_CASE("too few points are refused with their number") {
  CHECK_THROWS_WITH(Stage("registration.global").run(Cloud(Points::Random(3, 20)), shapes(1)),
                    Catch::Contains("the source has 20 points"));
}

TEST_CASE("the cloud given back lies on the target, columns with it, whatever the origin") {
  const Cloud target = shapes(1).with_origin(Eigen::Vector3d::Zero());
  const Cloud source =
      Cloud(target.position_column(), Eigen::Vector3d(4e5, 5e6, 100.0))
          .with("intensity", velum::Column(Eigen::VectorXf::Ones(target.size()).eval()));
  const Outcome outcome = Stage("registration.global").run(source, target);
  CHECK(outcome.cloud().has("intensity"));
  const Eigen::Vector3d p =
      outcome.cloud().origin() + outcome.cloud().positions().col(7).cast<double>();
  CHECK((p - target.positions().col(7).cast<double>()).norm() < 0.1);
  CHECK(static_cast<double>(outcome.get<velum::Table>().size()) == outcome.measure("iterations"));
}

TEST_CASE("a hundred starts: the thesis's failures", "[.][long]") {
  all_right(whole(), 100);
  all_right(part(), 100);
  CHECK(tally(parts(), 100).wrong == 0);
}

TEST_CASE("a hundred starts: bunny, street and kitchen", "[.][long]") {
  all_right(bunny("000", "045"), 100);
  all_right(bunny("000", "090"), 100);
  all_right(bunny("045", "090"), 100);
  all_right(street(), 100);
  all_right(kitchen(), 100);
}

TEST_CASE("a hundred starts: the wind tunnel", "[.][long]") {
  const Tally count = tally(tunnel(), 100);
  CHECK(count.right >= 95);
  CHECK(count.wrong == 0);
}

TEST_CASE("registering globally keeps to the promises of every stage") {
  for (const auto& fault : velum::test::conformance("registration.global")) FAIL_CHECK(fault);
}
