// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT

// The border-aware mode on simulated sails, against what the scene knows of them.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <velum/testing.hpp>

#include "mesh/distance.hpp"
#include "mesh/topology.hpp"

using velum::Cloud;
using velum::Index;
using velum::Mesh;
using velum::test::Stage;

namespace {

constexpr double kNoise = 0.004;

std::string scene() {
  return "\"" VELUM_SOURCE_DIR "/graphs/scenes/wind_tunnel.toml\"";
}

// The points of one sail in its own scanner's scan.
Cloud scan(const std::string& sail, const std::string& step, double noise) {
  const Cloud all = Stage("devices.simulator")
                        .set("scene", scene())
                        .set("scanner", sail)
                        .set("beam_step", step)
                        .set("tilt_step", step)
                        .set("noise", noise)
                        .run()
                        .cloud();
  std::vector<std::int32_t> kept;
  for (Index i = 0; i < all.size(); ++i)
    if (all.labels()[i] == (sail == "gennaker" ? 11 : 10))
      kept.push_back(static_cast<std::int32_t>(i));
  return all.select(kept);
}

// A scan with noise, the same beams without, and the sail that both saw.
struct Sail {
  Cloud noisy;
  Cloud exact;
  Mesh truth;
  std::vector<std::int32_t> loop;  // points around the border
  Eigen::Matrix3Xd normals;        // true ones at each point
  Eigen::VectorXd to_border;       // [m], of the true point from the true border

  Sail(const std::string& name, const std::string& step)
      : noisy(scan(name, step, kNoise)), exact(scan(name, step, 0.0)) {
    const Mesh made = Stage("devices.truth")
                          .set("scene", scene())
                          .set("object", name)
                          .set("frame", name)
                          .run()
                          .mesh();
    truth = made.with_vertices(made.vertices().with_origin(exact.origin()));
    REQUIRE(noisy.column("beam").vector<int>() == exact.column("beam").vector<int>());
    REQUIRE(noisy.column("line").vector<int>() == exact.column("line").vector<int>());
    trace_border();
    ask_truth();
  }

  [[nodiscard]] double length(const Cloud& cloud) const {
    return velum::mesh::loop_length(cloud.positions(), loop);
  }
  [[nodiscard]] bool inside(Index i) const { return to_border[i] > 1.5 * exact.spacing(); }

 private:
  void trace_border() {
    const Eigen::VectorXi number =
        Eigen::VectorXi::LinSpaced(exact.size(), 0, static_cast<int>(exact.size()) - 1);
    const Mesh mesh =
        Stage("meshing.delaunay_projected").run(exact.with("number", velum::Column(number))).mesh();
    const auto numbers = mesh.vertices().column("number").vector<int>();
    const auto loops =
        velum::mesh::border_loops(mesh.triangles(), velum::mesh::adjacency(mesh.triangles()));
    for (const std::int32_t vertex : loops.at(0)) loop.push_back(numbers[vertex]);
  }

  void ask_truth() {
    const velum::mesh::DistanceTree tree(truth);
    const auto corners = truth.positions();
    const auto triangles = truth.triangles();
    const auto edge = velum::mesh::border_loops(triangles, velum::mesh::adjacency(triangles)).at(0);
    normals.resize(3, exact.size());
    to_border.resize(exact.size());
    for (Index i = 0; i < exact.size(); ++i) {
      const Eigen::Vector3d p = exact.positions().col(i).cast<double>();
      const Index t = tree.closest(p).triangle;
      const Eigen::Vector3d a = corners.col(triangles(0, t)).cast<double>();
      const Eigen::Vector3d b = corners.col(triangles(1, t)).cast<double>();
      const Eigen::Vector3d c = corners.col(triangles(2, t)).cast<double>();
      normals.col(i) = (b - a).cross(c - a).normalized();
      double nearest = 1e9;
      for (const std::int32_t vertex : edge)
        nearest = std::min(nearest, (corners.col(vertex).cast<double>() - p).norm());
      to_border[i] = nearest;
    }
  }
};

struct Errors {
  double inside = 0.0;  // height over the true surface [m], RMS
  double border = 0.0;
  double sideways = 0.0;  // along the surface, border points [m], RMS
  double normals = 0.0;   // all points [deg], RMS
  double moved = 0.0;     // border points [m], RMS
};

Errors errors(const Sail& sail, const Cloud& cloud) {
  Errors sum;
  double in = 0.0, out = 0.0;
  for (Index i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d n = sail.normals.col(i);
    const Eigen::Vector3d off =
        (cloud.positions().col(i) - sail.exact.positions().col(i)).cast<double>();
    const double height = off.dot(n);
    const Eigen::Vector3d normal = cloud.normals().col(i).cast<double>();
    sum.normals += std::pow(std::atan2(normal.cross(n).norm(), std::abs(normal.dot(n))), 2);
    if (sail.inside(i)) {
      sum.inside += height * height;
      in += 1.0;
      continue;
    }
    sum.border += height * height;
    sum.sideways += (off - height * n).squaredNorm();
    sum.moved += static_cast<double>(
        (cloud.positions().col(i) - sail.noisy.positions().col(i)).squaredNorm());
    out += 1.0;
  }
  REQUIRE(in > 500.0);
  REQUIRE(out > 100.0);
  return {std::sqrt(sum.inside / in), std::sqrt(sum.border / out), std::sqrt(sum.sideways / out),
          std::sqrt(sum.normals / (in + out)) * 180.0 / std::numbers::pi,
          std::sqrt(sum.moved / out)};
}

velum::test::Outcome smooth(const Cloud& cloud, const char* radius, const char* border) {
  return Stage("resampling.mls").set("radius", radius).set("border", border).run(cloud);
}

void check_sail(const std::string& name, const std::string& step, const char* radius) {
  CAPTURE(name, step);
  const Sail sail(name, step);
  const auto outcome = smooth(sail.noisy, radius, "aware");
  const Cloud& cloud = outcome.cloud();
  REQUIRE(cloud.size() == sail.noisy.size());
  const Errors found = errors(sail, cloud);
  CHECK(found.inside < 0.35 * kNoise);
  CHECK(found.border < 0.35 * kNoise);
  CHECK(found.normals < 1.5);
  CHECK(found.moved < 1.05 * kNoise);
  CHECK(found.sideways < 0.4 * kNoise);
  // Noise alone lengthens the border by 0.5 to 2 %.
  const double truth = sail.length(sail.exact);
  CHECK(std::abs(sail.length(sail.noisy) - truth) > 0.004 * truth);
  CHECK(std::abs(sail.length(cloud) - truth) < 0.003 * truth);
  CHECK(outcome.measure("border_points") > 0.5 * static_cast<double>(sail.loop.size()));
  // The plain mode is worse at each of them.
  const Cloud plain = smooth(sail.noisy, radius, "plain").cloud();
  const Errors before = errors(sail, plain);
  CHECK(found.border < before.border);
  CHECK(found.normals < before.normals);
  CHECK(found.sideways < before.sideways);
  CHECK(std::abs(sail.length(cloud) - truth) < std::abs(sail.length(plain) - truth));
}

}  // namespace

TEST_CASE("gennaker at a quarter of a degree") {
  check_sail("gennaker", "0.25 deg", "100 mm");
}

TEST_CASE("mainsail at a quarter of a degree") {
  check_sail("mainsail", "0.25 deg", "100 mm");
}

TEST_CASE("gennaker at half a degree") {
  check_sail("gennaker", "0.5 deg", "120 mm");
}

TEST_CASE("mainsail at half a degree") {
  check_sail("mainsail", "0.5 deg", "120 mm");
}

TEST_CASE("without a sensor points move along the normal") {
  const Sail sail("gennaker", "0.5 deg");
  const Cloud cloud = smooth(sail.noisy.with_sensors({}), "120 mm", "aware").cloud();
  double most = 0.0;
  for (Index i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d step =
        (cloud.positions().col(i) - sail.noisy.positions().col(i)).cast<double>();
    const Eigen::Vector3d n = sail.normals.col(i);
    if (sail.inside(i)) most = std::max(most, (step - step.dot(n) * n).norm());
  }
  CHECK(most < 0.4 * kNoise);
}

TEST_CASE("points that are exact stay where they are") {
  const Sail sail("mainsail", "0.5 deg");
  const Cloud cloud = smooth(sail.exact, "120 mm", "aware").cloud();
  CHECK(errors(sail, cloud).border < 1e-4);
  CHECK(errors(sail, cloud).inside < 1e-4);
  CHECK(sail.length(cloud) == Approx(sail.length(sail.exact)).epsilon(1e-4));
}

TEST_CASE("the column border marks the rim") {
  const Sail sail("gennaker", "0.5 deg");
  const Cloud cloud = smooth(sail.noisy, "120 mm", "aware").cloud();
  const auto border = cloud.column("border").vector<std::uint8_t>();
  double far = 0.0, rim = 0.0;
  for (Index i = 0; i < cloud.size(); ++i) {
    if (border[i] == 0) continue;
    rim += 1.0;
    if (sail.to_border[i] > 3.0 * sail.exact.spacing()) far += 1.0;
  }
  CHECK(rim > 60.0);
  CHECK(far <= 0.01 * rim);
}

TEST_CASE("conformance of the border-aware mode") {
  for (const auto& fault :
       velum::test::conformance("resampling.mls", {{"radius", "0.3"}, {"border", "aware"}}))
    FAIL_CHECK(fault);
}
