// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <velum/testing.hpp>

#include "mesh/distance.hpp"
#include "scene/scene.hpp"

using velum::Cloud;
using velum::Index;
using velum::Points;
using velum::test::Stage;

namespace {

constexpr double kDegree = 0.017453292519943295;
constexpr double kNoise = 0.004;

std::string scene_file(const std::string& name) {
  return std::string(VELUM_SOURCE_DIR) + "/graphs/scenes/" + name + ".toml";
}

Cloud scan(const std::string& scene, const std::string& scanner, bool mixed,
           const std::string& step) {
  Stage made("devices.simulator");
  made.set("scene", "\"" + scene_file(scene) + "\"").set("scanner", "\"" + scanner + "\"");
  made.set("mixed_pixels", mixed ? "true" : "false");
  made.set("beam_step", "\"" + step + "\"").set("tilt_step", "\"" + step + "\"");
  return made.run().cloud();
}

// All surfaces of a scene in a scanner's frame.
velum::mesh::DistanceTree truth(const std::string& name, const std::string& scanner) {
  const auto scene = velum::scene::read_scene(scene_file(name));
  const velum::Pose pose = scene.scanner(scanner).pose.inverse();
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3i> triangles;
  for (const auto& object : scene.objects) {
    const auto set = velum::scene::triangulate(object, 0.0003);
    const auto first = static_cast<int>(vertices.size());
    for (Index i = 0; i < set.vertices.cols(); ++i)
      vertices.push_back((pose * Eigen::Vector3d(set.vertices.col(i))).cast<float>());
    for (Index i = 0; i < set.triangles.cols(); ++i)
      triangles.emplace_back(set.triangles.col(i).array() + first);
  }
  Points points(3, static_cast<Index>(vertices.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i) points.col(static_cast<Index>(i)) = vertices[i];
  velum::Triangles faces(3, static_cast<Index>(triangles.size()));
  for (std::size_t i = 0; i < triangles.size(); ++i)
    faces.col(static_cast<Index>(i)) = triangles[i];
  return velum::mesh::DistanceTree(velum::Mesh(Cloud(std::move(points)), std::move(faces)));
}

// Points of sails, and mixed pixels farther than three deviations from all surfaces.
struct Count {
  double sail = 0;
  double mixed = 0;
  Count& operator+=(const Count& other) {
    sail += other.sail;
    mixed += other.mixed;
    return *this;
  }
};

Count count(const Cloud& cloud, const velum::mesh::DistanceTree& surfaces) {
  Count counted;
  for (Index i = 0; i < cloud.size(); ++i) {
    const int label = cloud.labels()[i];
    if (label == 10 || label == 11) ++counted.sail;
    if (label != -1) continue;
    const auto hit = surfaces.closest(cloud.positions().col(i).cast<double>());
    if (hit.distance2 > 9.0 * kNoise * kNoise) ++counted.mixed;
  }
  return counted;
}

// Shares removed of what the scanners of a scene saw: sails, mixed pixels.
Count removed(const std::string& scene, const std::vector<std::string>& scanners,
              const std::string& step) {
  Count all;
  Count gone;
  for (const std::string& scanner : scanners) {
    const auto surfaces = truth(scene, scanner);
    const Cloud cloud = scan(scene, scanner, true, step);
    const auto outcome = Stage("filtering.mixed_pixels").run(cloud);
    all += count(cloud, surfaces);
    const Count here = count(std::get<Cloud>(*outcome.results.at(1)), surfaces);
    INFO(scene << ", " << scanner << ", " << step);
    CHECK(here.sail <= 0.03 * all.sail);
    gone += here;
  }
  REQUIRE(all.sail > 0);
  REQUIRE(all.mixed > 0);
  return {gone.sail / all.sail, gone.mixed / all.mixed};
}

// A raster of rays ahead of the origin, half a degree apart: ranges are given by `range(x, z)`, the
// angles to the right and up [deg].
template <class Range>
Cloud raster(const Range& range, std::uint64_t seed = 1) {
  velum::Random random(seed);
  Points points(3, 41 * 41);
  Index at = 0;
  for (int z = -20; z <= 20; ++z)
    for (int x = -20; x <= 20; ++x) {
      const Eigen::Vector3d ray =
          Eigen::Vector3d(std::tan(0.5 * x * kDegree), 1.0, std::tan(0.5 * z * kDegree));
      const double r = range(0.5 * x, 0.5 * z);
      points.col(at++) = (ray * r + ray.normalized() * kNoise * random.gaussian()).cast<float>();
    }
  return Cloud(std::move(points))
      .with("label", velum::Column(Eigen::VectorXi::LinSpaced(41 * 41, 0, 41 * 41 - 1).eval()))
      .with_sensors({velum::Sensor{}});
}

// A target at 2 m before a background at 4 m, right of it; in between a column of mixed pixels.
double target(double x, double) {
  if (x == 0.0) return 3.1;
  return x < 0.0 ? 2.0 : 4.0;
}

}  // namespace

TEST_CASE("mixed pixels of the wind tunnel go, its sails stay") {
  const Count gone = removed("wind_tunnel", {"gennaker", "mainsail"}, "0.25 deg");
  CAPTURE(gone.mixed, gone.sail);
  CHECK(gone.mixed >= 0.95);
  CHECK(gone.sail < 0.005);
}

TEST_CASE("mixed pixels of the boat on the water go, its sails stay") {
  const Count gone = removed("on_field", {"mast", "winch"}, "0.25 deg");
  CAPTURE(gone.mixed, gone.sail);
  CHECK(gone.mixed >= 0.95);
  CHECK(gone.sail < 0.005);
}

TEST_CASE("half a degree between beams is less to judge by, and nearly enough") {
  const Count tunnel = removed("wind_tunnel", {"gennaker", "mainsail"}, "0.5 deg");
  CAPTURE(tunnel.mixed, tunnel.sail);
  CHECK(tunnel.mixed >= 0.95);
  CHECK(tunnel.sail < 0.02);
}

TEST_CASE("a scan without mixed pixels loses little") {
  // What goes are shrouds, and walls met at more than 86 degrees.
  const Cloud cloud = scan("wind_tunnel", "gennaker", false, "0.5 deg");
  const auto outcome = Stage("filtering.mixed_pixels").run(cloud);
  CHECK(outcome.measure("removed") < 0.015 * static_cast<double>(cloud.size()));
  const auto sails = [](const Cloud& of) {
    return static_cast<double>((of.labels().array() >= 10).count());
  };
  CHECK(sails(outcome.cloud()) > 0.985 * sails(cloud));
}

TEST_CASE("a column of points between two walls goes, all else stays") {
  const auto outcome = Stage("filtering.mixed_pixels").run(raster(target));
  CHECK(outcome.measure("removed") == Approx(41).margin(1));
  const Cloud& removed = std::get<Cloud>(*outcome.results.at(1));
  int column = 0;
  for (Index i = 0; i < removed.size(); ++i) column += removed.labels()[i] % 41 == 20 ? 1 : 0;
  CHECK(column == 41);
}

TEST_CASE("the scanner's place counts, not the axes") {
  const Cloud cloud = raster(target);
  velum::Pose motion = velum::Pose::Identity();
  motion.rotate(Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, 3).normalized()));
  motion.pretranslate(Eigen::Vector3d(30, -20, 7));
  const auto outcome = Stage("filtering.mixed_pixels").run(cloud.transformed(motion));
  CHECK(outcome.measure("removed") == Approx(41).margin(1));
}

TEST_CASE("two scanners are judged one by one") {
  const Cloud one = raster(target, 1);
  velum::Pose motion = velum::Pose::Identity();
  motion.translation() << 5, 1, 2;
  const Cloud other = raster(target, 2).transformed(motion);
  const std::vector<Cloud> both{one, other};
  velum::VectorXu8 sensor(2 * one.size());
  sensor << velum::VectorXu8::Zero(one.size()), velum::VectorXu8::Ones(one.size());
  const Cloud told = velum::merge(both).with("sensor", velum::Column(sensor));
  CHECK(Stage("filtering.mixed_pixels").run(told).measure("removed") == Approx(82).margin(2));
}

TEST_CASE("against the sky there are no mixed pixels") {
  // Only a string of points, as of a rope around the scanner: nothing is behind them.
  Points points(3, 40);
  for (Index i = 0; i < 40; ++i) {
    const double angle = 0.5 * kDegree * static_cast<double>(i);
    points.col(i) =
        Eigen::Vector3d(0.0, 3.0 * std::cos(angle), 3.0 * std::sin(angle)).cast<float>();
  }
  CHECK(Stage("filtering.mixed_pixels").run(Cloud(std::move(points))).measure("removed") == 0.0);
}

TEST_CASE("a surface met at 78 degrees stays") {
  // A floor 0.5 m below the scanner, from 2.3 m on.
  const auto floor = [](double, double z) { return 0.5 / std::tan((12.0 - 0.5 * z) * kDegree); };
  const Cloud cloud = raster(floor);
  CHECK(Stage("filtering.mixed_pixels").run(cloud).measure("removed") <=
        0.01 * static_cast<double>(cloud.size()));
}

TEST_CASE("what stays keeps order, columns and sensors") {
  const auto outcome = Stage("filtering.mixed_pixels").run(raster(target));
  CHECK(outcome.cloud().sensors().size() == 1);
  const auto labels = outcome.cloud().labels();
  CHECK(std::is_sorted(labels.begin(), labels.end()));
  CHECK(outcome.measure("kept") + outcome.measure("removed") == 41 * 41);
}

TEST_CASE("a scanner without noise is refused") {
  CHECK_THROWS_AS(Stage("filtering.mixed_pixels").set("noise", "0"), velum::Error);
  CHECK_THROWS_AS(Stage("filtering.mixed_pixels").set("spot", "-1 mm"), velum::Error);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("filtering.mixed_pixels")) FAIL_CHECK(fault);
}
