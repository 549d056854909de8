// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "scene/sail.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "scene/surface.hpp"

using namespace velum;
using namespace velum::scene;
using Eigen::Vector3d;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

SailDesign design() {
  SailDesign d;
  d.tack = {0.1, 0.2, 1.0};
  d.head = {-0.2, 0.2, 3.0};
  d.sag_aft = 0.03;
  d.sag_lee = 0.08;
  d.angle = 15.0 * kDegree;
  d.clew_height = 0.1;
  d.foot_round = 0.05;
  d.sections = {{0.0, 1.0, 0.08, 0.45, 0.0},
                {0.3, 0.9, 0.12, 0.42, 4.0 * kDegree},
                {0.6, 0.6, 0.14, 0.50, 9.0 * kDegree},
                {1.0, 0.1, 0.06, 0.38, 15.0 * kDegree}};
  return d;
}

struct Measured {
  double chord, camber, draft, angle;
};

// The section's values from many points on it, by the definitions and nothing else.
Measured measure(const Sail& sail, double height) {
  const SailDesign& d = sail.design();
  const Vector3d luff = sail.at(0.0, height);
  const Vector3d chord = sail.at(1.0, height) - luff;
  const Vector3d along = chord.normalized();
  Measured m{chord.norm(), 0.0, 0.0, std::atan2(chord.dot(d.lee), chord.dot(d.aft))};
  for (int i = 0; i <= 20000; ++i) {
    const Vector3d offset = sail.at(i / 20000.0, height) - luff;
    CHECK(std::abs(offset.dot(d.up)) < 1e-12);
    const double depth = (offset - offset.dot(along) * along).norm();
    if (depth > m.camber) {
      m.camber = depth;
      m.draft = offset.dot(along);
    }
  }
  m.camber /= m.chord;
  m.draft /= m.chord;
  return m;
}

}  // namespace

TEST_CASE("sections have exactly the chord, camber, draft and twist that were given") {
  const Sail sail(design());
  for (const SailSection& given : design().sections) {
    const Measured m = measure(sail, given.height);
    CHECK(m.chord == Approx(given.chord).margin(1e-12));
    CHECK(m.camber == Approx(given.camber).margin(1e-8));
    CHECK(m.draft == Approx(given.draft).margin(1e-4));
    CHECK(m.angle == Approx(15.0 * kDegree + given.twist).margin(1e-12));
  }
}

TEST_CASE("between the given heights sections are what section() says") {
  const Sail sail(design());
  for (const double height : {0.12, 0.47, 0.81}) {
    const SectionValues said = sail.section(height);
    const Measured m = measure(sail, height);
    CHECK(m.chord == Approx(said.chord));
    CHECK(m.camber == Approx(said.camber).margin(1e-8));
    CHECK(m.draft == Approx(said.draft).margin(1e-4));
    CHECK(m.angle == Approx(said.angle));
    const Vector3d chord = sail.at(1, height) - sail.at(0, height);
    const Vector3d start = sail.at(1e-6, height) - sail.at(0, height);
    const Vector3d end = sail.at(1, height) - sail.at(1 - 1e-6, height);
    CHECK(std::acos(chord.dot(start) / chord.norm() / start.norm()) ==
          Approx(said.entry).margin(1e-4));
    CHECK(std::acos(chord.dot(end) / chord.norm() / end.norm()) == Approx(said.exit).margin(1e-4));
  }
}

TEST_CASE("the corners are tack, head and clew") {
  const Sail sail(design());
  CHECK((sail.point(0, 0) - design().tack).norm() < 1e-12);
  CHECK((sail.point(0, 1) - design().head).norm() < 1e-12);
  CHECK((sail.point(1, 0) - sail.clew()).norm() < 1e-12);
  CHECK(sail.clew().z() == Approx(1.0 + 0.1 * 2.0));
  // The foot hangs below the line from tack to clew by its round.
  CHECK(sail.point(0.5, 0).z() == Approx(1.0 + 0.05 * 2.0 - 0.05));
}

TEST_CASE("a flat straight sail has the lengths and area of a trapezium") {
  SailDesign d;
  d.head = {0, 0, 2};
  d.sections = {{0.0, 1.0, 0.0, 0.45, 0.0}, {1.0, 0.5, 0.0, 0.45, 0.0}};
  const Sail sail(d);
  CHECK(sail.luff() == Approx(2.0));
  CHECK(sail.foot() == Approx(1.0));
  CHECK(sail.leech() == Approx(std::hypot(2.0, 0.5)));
  CHECK(sail.area() == Approx(1.5));
}

TEST_CASE("a grid is as near to the surface as asked, and faces leeward") {
  const Sail sail(design());
  const Sail::Grid grid = sail.grid_within(1e-4);
  double worst = 0.0;
  const auto across = static_cast<Index>(
      std::lround(static_cast<double>(grid.vertices.cols()) /
                  static_cast<double>(grid.vertices.cols() - grid.triangles.cols() / 2)));
  CHECK(across > 0);
  // Middles of edges against the surface's nearest of a fine net about the same parameters.
  const Sail::Grid fine = sail.grid(800, 800);
  for (Index i = 0; i < grid.triangles.cols(); i += 97) {
    const Vector3d a = grid.vertices.col(grid.triangles(0, i));
    const Vector3d b = grid.vertices.col(grid.triangles(1, i));
    const Vector3d c = grid.vertices.col(grid.triangles(2, i));
    const Vector3d normal = (b - a).cross(c - a);
    CHECK(normal.dot(design().lee) > 0.0);
    Index nearest = 0;
    (fine.vertices.colwise() - 0.5 * (a + b)).colwise().squaredNorm().minCoeff(&nearest);
    const Vector3d gap = fine.vertices.col(nearest) - 0.5 * (a + b);
    worst = std::max(worst, std::abs(gap.dot(normal.normalized())));
  }
  CHECK(worst < 1.5e-4);
}

TEST_CASE("a sail to port is the mirror image of one to starboard") {
  SailDesign mirrored = design();
  mirrored.lee = -mirrored.lee;
  const Sail starboard(design());
  const Sail port(mirrored);
  CHECK(port.area() == Approx(starboard.area()));
  const Vector3d a = starboard.point(0.3, 0.6);
  const Vector3d b = port.point(0.3, 0.6);
  CHECK(a.x() == Approx(b.x()));
  CHECK(a.y() - 0.2 == Approx(0.2 - b.y()));
  const Sail::Grid grid = port.grid(10, 10);
  const Vector3d p = grid.vertices.col(grid.triangles(0, 5));
  const Vector3d q = grid.vertices.col(grid.triangles(1, 5));
  const Vector3d r = grid.vertices.col(grid.triangles(2, 5));
  CHECK((q - p).cross(r - p).dot(mirrored.lee) > 0.0);
}

TEST_CASE("a spline of a straight line is that line, also beyond its ends") {
  const Spline line({0.0, 0.2, 1.0}, {1.0, 1.4, 3.0});
  for (const double x : {-0.5, 0.0, 0.1, 0.6, 1.0, 1.5})
    CHECK(line(x) == Approx(1.0 + 2.0 * x).margin(1e-12));
  const Spline single({0.4}, {7.0});
  CHECK(single(0.0) == 7.0);
  const Spline bent({0.0, 1.0, 2.0}, {0.0, 1.0, 0.0});
  CHECK(bent(1.0) == Approx(1.0));
  CHECK(bent(0.5) == Approx(bent(1.5)));
  CHECK(bent(0.5) > 0.5);
}

TEST_CASE("the B-spline of a sail starts and ends at its corners") {
  const Sail sail(design());
  const Surface surface = surface_of(sail, Pose::Identity());
  const Index along = surface.knots_v.size() - surface.degree_v - 1;
  const Index last = surface.control.cols() - 1;
  CHECK(surface.control.cols() == along * (surface.knots_u.size() - surface.degree_u - 1));
  CHECK((surface.control.col(0) - design().tack).norm() < 1e-9);
  CHECK((surface.control.col(along - 1) - design().head).norm() < 1e-9);
  CHECK((surface.control.col(last - along + 1) - sail.clew()).norm() < 1e-9);
}
