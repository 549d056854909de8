// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <velum/testing.hpp>

#include "bspline/evaluate.hpp"
#include "mesh/distance.hpp"
#include "mesh/topology.hpp"

using Eigen::Vector3d;
using velum::Cloud;
using velum::Index;
using velum::Mesh;
using velum::Surface;
using velum::test::Outcome;
using velum::test::Stage;

namespace {

// An arched sheet [0, 1] × [0, 2], z up, arched by 0.1 towards y, with noise across it.
Cloud arched(Index n, double noise, double turn = 0.0) {
  velum::Random random(7);
  velum::Points points(3, n * 2 * n);
  for (Index j = 0; j < 2 * n; ++j)
    for (Index i = 0; i < n; ++i) {
      const double s = static_cast<double>(i) / static_cast<double>(n - 1);
      const double h = static_cast<double>(j) / static_cast<double>(2 * n - 1);
      const double y = 0.4 * s * (1.0 - s) + noise * random.gaussian();
      const double angle = turn * h;
      points.col(j * n + i) << static_cast<float>(std::cos(angle) * s - std::sin(angle) * y),
          static_cast<float>(std::sin(angle) * s + std::cos(angle) * y),
          static_cast<float>(2.0 * h);
    }
  return Cloud(std::move(points));
}

using Polygon = std::vector<Vector3d>;

Polygon border_of(const Mesh& mesh, std::size_t& loops) {
  const auto found =
      velum::mesh::border_loops(mesh.triangles(), velum::mesh::adjacency(mesh.triangles()));
  loops = found.size();
  Polygon polygon;
  for (const std::int32_t v : found.at(0))
    polygon.push_back(mesh.positions().col(v).cast<double>());
  return polygon;
}

double length_of(const Polygon& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    sum += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  return sum;
}

double distance(const Vector3d& p, const Polygon& polygon) {
  double least = 1e9;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d a = polygon[i];
    const Vector3d edge = polygon[(i + 1) % polygon.size()] - a;
    const double square = edge.squaredNorm();
    const double s = square > 0.0 ? std::clamp((p - a).dot(edge) / square, 0.0, 1.0) : 0.0;
    least = std::min(least, (a + s * edge - p).norm());
  }
  return least;
}

// Mean distance to the four nearest of the twelve points nearest to a place.
double spacing_at(const Cloud& cloud, const Vector3d& p) {
  std::vector<velum::Neighbour> around;
  std::vector<velum::Neighbour> four;
  cloud.neighbours().nearest(p.cast<float>(), 12, around);
  double sum = 0.0;
  for (const velum::Neighbour& one : around) {
    cloud.neighbours().nearest(cloud.positions().col(one.index), 5, four);
    for (std::size_t k = 1; k < four.size(); ++k) sum += std::sqrt(four[k].distance2);
  }
  return sum / (4.0 * static_cast<double>(around.size()));
}

struct Sail {
  const char* scene;
  const char* object;
  const char* scanner;
  int label;
};
const std::vector<Sail> kSails{{"wind_tunnel", "gennaker", "gennaker", 11},
                               {"wind_tunnel", "mainsail", "mainsail", 10},
                               {"on_field", "jib", "mast", 11}};

std::string scene_of(const Sail& sail) {
  return std::string(VELUM_SOURCE_DIR) + "/graphs/scenes/" + sail.scene + ".toml";
}

// The truth in the scanner's frame, about its origin.
Mesh truth_of(const Sail& sail) {
  Stage stage("devices.truth");
  stage.set("scene", scene_of(sail)).set("object", sail.object).set("frame", sail.scanner);
  const Outcome outcome = stage.run();
  return outcome.mesh().with_vertices(outcome.mesh().vertices().with_origin(Vector3d::Zero()));
}

// Height above which the sail is thinned.
double top_of(const Mesh& truth) {
  const double low = truth.positions().row(2).minCoeff();
  const double high = truth.positions().row(2).maxCoeff();
  return high - 0.1 * (high - low);
}

// What the sail's own scanner sees of it at half a degree with 4 mm of noise, the top tenth thinned
// to a fifth.
Cloud scan_of(const Sail& sail, double top, std::uint64_t seed) {
  Stage simulator("devices.simulator");
  simulator.set("scene", scene_of(sail)).set("scanner", sail.scanner);
  simulator.set("beam_step", "0.5 deg").set("tilt_step", "0.5 deg").set("noise", "4 mm");
  const Cloud all = simulator.seed(seed).run().cloud();
  velum::Random random(7 * seed);
  std::vector<std::int32_t> own;
  for (Index i = 0; i < all.size(); ++i) {
    if (all.labels()[i] != sail.label) continue;
    if (all.positions()(2, i) > top && random.uniform() > 0.2) continue;
    own.push_back(static_cast<std::int32_t>(i));
  }
  return all.select(own);
}

struct Figures {
  double rms = 0.0;     // to the truth [m]
  double top = 0.0;     // the same over the thinned top
  double border = 0.0;  // farthest between both borders, in local spacings, away from the head
  double head = 0.0;    // and at it
  double length = 0.0;  // error of the border's length
  double overshoot = 0.0;
  std::size_t loops = 0;
};

Figures compare(const Mesh& mesh, const Mesh& truth, const Cloud& cloud) {
  Figures figures;
  const velum::mesh::DistanceTree tree(truth);
  std::size_t loops = 0;
  const Polygon known = border_of(truth, loops);
  const Polygon found = border_of(mesh, figures.loops);
  const double top = top_of(truth);
  double squares[2] = {0.0, 0.0};
  double counts[2] = {0.0, 0.0};
  for (Index i = 0; i < mesh.positions().cols(); ++i) {
    const Vector3d p = mesh.positions().col(i).cast<double>();
    const auto hit = tree.closest(p);
    if (distance(hit.point, known) < 1e-4) continue;  // beyond the border
    const std::size_t part = p.z() > top ? 1 : 0;
    squares[part] += hit.distance2;
    counts[part] += 1.0;
  }
  figures.rms = std::sqrt(squares[0] / counts[0]);
  figures.top = std::sqrt(squares[1] / std::max(1.0, counts[1]));
  const double high = truth.positions().row(2).maxCoeff();
  const auto off = [&](const Vector3d& p, const Polygon& other) {
    const double spacing = spacing_at(cloud, p);
    double& worst = p.z() > high - 2.0 * spacing ? figures.head : figures.border;
    worst = std::max(worst, distance(p, other) / spacing);
  };
  std::vector<double> beyond;
  for (const Vector3d& p : found) {
    off(p, known);
    const auto hit = tree.closest(p);
    const bool out = distance(hit.point, known) < 1e-4;
    beyond.push_back(out ? std::sqrt(hit.distance2) / spacing_at(cloud, p) : 0.0);
  }
  for (const Vector3d& p : known) off(p, found);
  std::sort(beyond.begin(), beyond.end());
  figures.overshoot = beyond[beyond.size() * 95 / 100];
  figures.length = length_of(found) / length_of(known) - 1.0;
  return figures;
}

}  // namespace

TEST_CASE("an arched sheet is fitted to a part of its noise") {
  const Outcome outcome = Stage("meshing.bspline").run(arched(24, 0.004));
  CHECK(outcome.measure("noise") == Approx(0.004).epsilon(0.1));
  const auto& mesh = outcome.mesh();
  double squares = 0.0;
  for (Index i = 0; i < mesh.positions().cols(); ++i) {
    const double s = mesh.positions()(0, i);
    const double off = mesh.positions()(1, i) - 0.4 * s * (1.0 - s);
    squares += off * off;
  }
  CHECK(std::sqrt(squares / static_cast<double>(mesh.positions().cols())) < 0.0012);
  CHECK(mesh.positions().row(2).maxCoeff() == Approx(2.0).margin(0.044));
}

TEST_CASE("without noise the surface lies within a hair of the points") {
  const Outcome outcome = Stage("meshing.bspline").run(arched(20, 0.0));
  CHECK(outcome.measure("rms") < 1e-4);
}

TEST_CASE("a sheet twisted by more than a right angle does not fold") {
  const Outcome outcome = Stage("meshing.bspline").run(arched(24, 0.001, 2.6));
  CHECK(outcome.measure("rms") < 0.0015);
  const Surface& surface = outcome.get<Surface>();
  const velum::bspline::Patch patch(surface);
  // One side throughout: the normals turn, but never at once.
  double least = 1.0;
  for (double v = 0.0; v < 0.98; v += 0.02)
    for (double u = 0.0; u < 1.0; u += 0.05) {
      const Eigen::Vector2d here(u, v);
      const Eigen::Vector2d above(u, v + 0.02);
      if (!velum::bspline::inside(surface.trimming, here) ||
          !velum::bspline::inside(surface.trimming, above))
        continue;
      least =
          std::min(least, patch.derivatives(here).normal().dot(patch.derivatives(above).normal()));
    }
  CHECK(least > 0.9);
}

TEST_CASE("v runs upward, and the normal faces the scanner") {
  Cloud cloud = arched(20, 0.002);
  velum::Sensor sensor;
  for (const double side : {-5.0, 5.0}) {
    sensor.pose.translation() << 0.5, side, 1.0;
    const Outcome outcome = Stage("meshing.bspline").run(cloud.with_sensors({sensor}));
    const velum::bspline::Patch patch(outcome.get<Surface>());
    const auto middle = patch.derivatives({0.5, 0.5});
    CHECK(middle.dv.normalized().z() > 0.9);
    CHECK(middle.normal().y() * side > 0.0);
    CHECK(outcome.mesh().sensors().size() == 1);
  }
}

TEST_CASE("the mesh has one border, at the wanted resolution, and holes as asked") {
  const Cloud whole = arched(30, 0.002);
  std::vector<std::int32_t> kept;
  for (Index i = 0; i < whole.size(); ++i) {
    const Eigen::Vector3f p = whole.positions().col(i);
    if (std::hypot(p.x() - 0.5F, p.z() - 1.0F) > 0.25F)
      kept.push_back(static_cast<std::int32_t>(i));
  }
  const Cloud cloud = whole.select(kept);
  std::size_t loops = 0;
  const Outcome bridged = Stage("meshing.bspline").set("resolution", "50 mm").run(cloud);
  border_of(bridged.mesh(), loops);
  CHECK(loops == 1);
  CHECK(bridged.measure("holes") == 1.0);
  const Outcome cut =
      Stage("meshing.bspline").set("resolution", "50 mm").set("holes", "\"cut\"").run(cloud);
  border_of(cut.mesh(), loops);
  CHECK(loops == 2);
  CHECK(cut.get<Surface>().trimming.size() == 2);
  const Outcome fine = Stage("meshing.bspline").set("resolution", "25 mm").run(cloud);
  CHECK(fine.mesh().size() > 3 * bridged.mesh().size());
}

TEST_CASE("more smoothness leaves fewer free parameters, knots are added where they are missing") {
  const Cloud cloud = arched(24, 0.003);
  const Outcome usual = Stage("meshing.bspline").run(cloud);
  const Outcome stiff = Stage("meshing.bspline").set("smoothness", "10000").run(cloud);
  CHECK(stiff.measure("freedom") < usual.measure("freedom"));
  velum::Points waves = cloud.positions();
  for (Index i = 0; i < waves.cols(); ++i) waves(1, i) += 0.03F * std::sin(14.0F * waves(2, i));
  const Cloud wavy = cloud.with_positions(waves);
  const Outcome few =
      Stage("meshing.bspline").set("refinement", "0").set("iterations", "20").run(wavy);
  const Outcome more = Stage("meshing.bspline").set("iterations", "20").run(wavy);
  CHECK(more.measure("control_points") > few.measure("control_points"));
  CHECK(more.measure("noise") < 0.7 * few.measure("noise"));
}

TEST_CASE("simulated sails come out as they are made, with the same settings") {
  // The jib's head is seen from 9 m away at a grazing angle: of its top metre three returns are
  // left, which do not say where it ends.
  struct Most {
    double top, border, head, length;
  };
  const std::vector<Most> most{
      {0.003, 1.0, 2.0, 0.005}, {0.003, 1.0, 2.0, 0.01}, {0.005, 1.5, 4.0, 0.05}};
  for (std::size_t i = 0; i < kSails.size(); ++i) {
    const Sail& sail = kSails[i];
    CAPTURE(sail.object);
    const Mesh truth = truth_of(sail);
    const Cloud cloud = scan_of(sail, top_of(truth), 1);
    const Outcome outcome = Stage("meshing.bspline").run(cloud);
    CHECK(outcome.measure("corners") == 1.0);
    const Figures figures = compare(outcome.mesh(), truth, cloud);
    CAPTURE(figures.border, figures.head, figures.length);
    CHECK(figures.rms < 0.001);
    CHECK(figures.top < most[i].top);
    CHECK(figures.border < most[i].border);
    CHECK(figures.head < most[i].head);
    CHECK(std::abs(figures.length) < most[i].length);
    CHECK(figures.overshoot < 0.5);
    CHECK(figures.loops == 1);
  }
}

TEST_CASE("too few points, and points on a line, are refused with a reason") {
  CHECK_THROWS_AS(Stage("meshing.bspline").run(Cloud(velum::Points::Random(3, 12))), velum::Error);
  velum::Points line = velum::Points::Zero(3, 50);
  for (Index i = 0; i < 50; ++i) line(0, i) = static_cast<float>(i);
  CHECK_THROWS_AS(Stage("meshing.bspline").run(Cloud(line)), velum::Error);
  CHECK_THROWS_AS(Stage("meshing.bspline").set("order", "1").run(arched(20, 0.0)), velum::Error);
}

TEST_CASE("meshing.bspline keeps the promises of every stage") {
  for (const auto& fault : velum::test::conformance("meshing.bspline")) FAIL_CHECK(fault);
}
