// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "scene/scan.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <numbers>

#include "run/local_context.hpp"
#include "velum/values.hpp"

using namespace velum;
using namespace velum::scene;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Cloud scan_of(const Scene& scene, bool mixed = false, std::uint64_t seed = 1, int threads = 2) {
  run::LocalContext context(threads, seed);
  Scanner scanner = scene.scanners.front();
  if (mixed) scanner.effects.with(Effect::mixed_pixels);
  return scan(scene, scanner, context.random(), context);
}

Scene scene_of(const std::string& text) {
  return parse_scene("format = 1\nunits = \"m\"\n" + text, "test.toml");
}

const std::string kWall =
    "[object.wall]\nshape = \"plane\"\nlabel = 1\nposition = [0, 4, 0]\nnormal = [0, -1, 0]\n";

}  // namespace

TEST_CASE("ranges on a wall have the stated mean and spread") {
  const Scene scene = scene_of(kWall +
                               "[scanner.a]\nbeam_from = 60\nbeam_to = 120\ntilt_from = -30\n"
                               "tilt_to = 30\nnoise = 0.004\n");
  const Cloud cloud = scan_of(scene);
  CHECK(cloud.size() == 241 * 241);
  double sum = 0.0;
  double squares = 0.0;
  for (Index i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = cloud.positions().col(i).cast<double>();
    const double error = p.norm() - 4.0 * p.norm() / p.y();
    sum += error;
    squares += error * error;
  }
  const auto n = static_cast<double>(cloud.size());
  CHECK(sum / n == Approx(0.0).margin(5e-5));
  CHECK(std::sqrt(squares / n) == Approx(0.004).epsilon(0.02));
}

TEST_CASE("without noise points lie on the surface, and beams and lines say where they came from") {
  const Scene scene = scene_of(kWall +
                               "[scanner.a]\nbeam_from = 0\nbeam_to = 180\nbeam_step = 1\n"
                               "tilt_from = -10\ntilt_to = 10\ntilt_step = 1\nnoise = 0\n");
  const Cloud cloud = scan_of(scene);
  const auto beams = cloud.column(column::kBeam).vector<std::int32_t>();
  const auto lines = cloud.column(column::kLine).vector<std::int32_t>();
  const auto tilts = cloud.column(column::kTilt).vector<float>();
  for (Index i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = cloud.positions().col(i).cast<double>();
    if (p.norm() < 40.0) CHECK(p.y() == Approx(4.0).margin(1e-5));
    const double tilt = (-10.0 + lines[i]) * kDegree;
    CHECK(tilts[i] == Approx(tilt).margin(1e-6));
    CHECK(std::atan2(p.z(), p.y()) == Approx(tilt).margin(1e-5));
    CHECK(std::acos(p.x() / p.norm()) == Approx(beams[i] * kDegree).margin(1e-5));
  }
  // Beams along the wall and those that meet it beyond 80 m give nothing.
  CHECK(cloud.size() == 21 * (181 - 6));
  CHECK(cloud.sensors().size() == 1);
  CHECK(cloud.sensors().front().name == "a");
}

TEST_CASE("the field of view of the LMS 511 is 190 degrees") {
  const Scene scene = scene_of(
      "[object.room]\nshape = \"box\"\nlabel = 1\nsize = [10, 10, 10]\n"
      "[scanner.a]\ntilt_from = 0\ntilt_to = 0\nbeam_step = 0.5\nnoise = 0\n");
  const Cloud cloud = scan_of(scene);
  CHECK(cloud.size() == 381);
  const Eigen::Vector3f first = cloud.positions().col(0);
  const Eigen::Vector3f last = cloud.positions().col(380);
  CHECK(std::atan2(first.y(), first.x()) == Approx(-5.0 * kDegree).margin(1e-6));
  CHECK(std::atan2(last.y(), last.x()) == Approx(-175.0 * kDegree).margin(1e-6));
}

TEST_CASE("what is in front hides what is behind") {
  const Scene scene = scene_of(
      kWall +
      "[object.board]\nshape = \"plane\"\nlabel = 2\nposition = [0, 2, 0]\nnormal = [0, 1, 0]\n"
      "size = [1, 1]\n[scanner.a]\nbeam_from = 45\nbeam_to = 135\ntilt_from = -45\ntilt_to = 45\n"
      "noise = 0\n");
  const Cloud cloud = scan_of(scene);
  std::map<int, Index> count;
  for (Index i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f p = cloud.positions().col(i);
    const bool board = cloud.labels()[i] == 2;
    ++count[cloud.labels()[i]];
    const Eigen::Vector3f at = p * (2.0F / p.y());
    const bool within = std::abs(at.x()) <= 0.5F && std::abs(at.z()) <= 0.5F;
    if (std::abs(std::abs(at.x()) - 0.5F) > 1e-3F && std::abs(std::abs(at.z()) - 0.5F) > 1e-3F)
      CHECK(board == within);
  }
  CHECK(count[1] + count[2] == cloud.size());
  CHECK(count[2] > 10000);
}

TEST_CASE("a scan is the same with 1 and 2 threads, and another with another seed") {
  const Scene scene = scene_of(kWall + "[scanner.a]\ntilt_from = -5\ntilt_to = 5\n");
  const std::string one = hash_of(Value(scan_of(scene, false, 1, 1)));
  CHECK(one == hash_of(Value(scan_of(scene, false, 1, 2))));
  CHECK(one != hash_of(Value(scan_of(scene, false, 2, 2))));
}

TEST_CASE("mixed pixels lie between the surfaces at an edge, and nowhere else") {
  const std::string board =
      "[object.board]\nshape = \"plane\"\nlabel = 2\nposition = [0, 1, 0]\nnormal = [0, 1, 0]\n"
      "size = [0.5, 0.5]\n";
  const std::string scanner =
      "[scanner.a]\nbeam_from = 60\nbeam_to = 120\ntilt_from = -30\ntilt_to = 30\nnoise = 0\n";
  const Cloud cloud = scan_of(scene_of(kWall + board + scanner), true);
  Index mixed = 0;
  for (Index i = 0; i < cloud.size(); ++i) {
    const double y = cloud.positions()(1, i);
    if (cloud.labels()[i] == -1) {
      ++mixed;
      CHECK((y > 1.0 && y < 4.0));
    } else {
      CHECK(std::min(std::abs(y - 1.0), std::abs(y - 4.0)) < 1e-4);
    }
  }
  // The edge is 2 m long, a beam every 4.36 mm each way or a little more, as the edge is farther
  // than 1 m; the outermost rays lie at 0.80 to 0.87 of the spot of 17.6 mm.
  CHECK(static_cast<double>(mixed) == Approx(2.0 * 0.8 * 0.0176 / (0.0045 * 0.0045)).epsilon(0.1));
  // Against the sky there is nothing to mix with (thesis 2.4.3.8).
  const Cloud sky = scan_of(scene_of(board + scanner), true);
  CHECK(sky.size() > 0);
  CHECK((sky.labels().array() == 2).all());
}

TEST_CASE("a scan stops when it is interrupted") {
  const Scene scene = scene_of(kWall + "[scanner.a]\n");
  run::LocalContext context(2, 1);
  context.cancel();
  CHECK_THROWS_AS(scan(scene, scene.scanners.front(), context.random(), context), Cancelled);
}
