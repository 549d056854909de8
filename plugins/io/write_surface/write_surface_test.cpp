// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "bspline/evaluate.hpp"
#include "formats/test_faults.hpp"
#include "formats/test_stages.hpp"

using velum::Error;
using velum::Index;
using velum::Mesh;
using velum::Surface;
using velum::formats::test::Folder;
using velum::formats::test::read_mesh_file;
using velum::formats::test::text_of;
using velum::test::Stage;

namespace {

constexpr double kPi = std::numbers::pi;

Stage stage(const std::filesystem::path& file) {
  return velum::formats::test::stage_on("io.write_surface", file);
}

/// z = 0.4 x² over the square [0, 2] × [0, 1] m, exact as a quadratic by linear surface.
Surface parabola() {
  Surface s;
  s.degree_u = 2;
  s.degree_v = 1;
  s.knots_u = velum::bspline::uniform_knots(2, 1);
  s.knots_v = velum::bspline::uniform_knots(1, 1);
  s.control.resize(3, 6);
  for (Index i = 0; i < 3; ++i)
    for (Index j = 0; j < 2; ++j)
      s.control.col(i * 2 + j) << static_cast<double>(i), static_cast<double>(j),
          i == 2 ? 1.6 : 0.0;
  return s;
}

/// A quarter of a cylinder of radius 1 and height 1, exact as a NURBS.
Surface quarter() {
  Surface s = parabola();
  const double h = std::sqrt(0.5);
  s.control << 1, 1, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1, 0, 1, 0, 1, 0, 1;
  s.weights.resize(6);
  s.weights << 1, 1, h, h, 1, 1;
  return s;
}

Eigen::Matrix2Xd circle(const Eigen::Vector2d& middle, double radius, int n) {
  Eigen::Matrix2Xd loop(2, n);
  for (int i = 0; i < n; ++i)
    loop.col(i) =
        middle + radius * Eigen::Vector2d(std::cos(2.0 * kPi * i / n), std::sin(2.0 * kPi * i / n));
  return loop;
}

/// A triangle with two straight sides and a hollow one, and a round hole.
Surface trimmed() {
  Surface s = parabola();
  s.origin << 10.0, -20.0, 5.0;
  Eigen::Matrix2Xd outer(2, 42);
  for (int i = 0; i <= 40; ++i) {
    const double t = i / 40.0;
    outer.col(i) << 0.9 - 0.8 * t - 0.3 * t * (1.0 - t), 0.1 + 0.8 * t;
  }
  outer.col(41) << 0.1, 0.1;
  s.trimming = {outer, circle({0.25, 0.35}, 0.08, 48)};
  return s;
}

double area_under(const Mesh& mesh) {
  double area = 0.0;
  const auto p = mesh.positions();
  const auto t = mesh.triangles();
  for (Index i = 0; i < t.cols(); ++i) {
    const Eigen::Vector3d a = p.col(t(0, i)).cast<double>();
    area +=
        0.5 * (p.col(t(1, i)).cast<double>() - a).cross(p.col(t(2, i)).cast<double>() - a).norm();
  }
  return area;
}

bool has(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

constexpr const char* kExact[] = {"step", "iges"};
constexpr const char* kFormats[] = {"step", "iges", "stl", "obj", "ply", "off", "vtk", "glb"};

}  // namespace

TEST_CASE("a whole surface is one face with the area and border of the parabola") {
  const Folder folder;
  const double length = 0.5 * 2.0 * std::sqrt(1.0 + 2.56) + std::asinh(1.6) / 1.6;  // of z = 0.4 x²
  for (const char* format : kExact) {
    INFO(format);
    const auto out = stage(folder / "a.dat").set("format", format).run(parabola());
    CHECK(out.measure("loops") == 1);
    CHECK(out.measure("area") == Approx(length).epsilon(1e-6));
    CHECK(out.measure("border_length") == Approx(2.0 * length + 2.0).epsilon(1e-6));
    CHECK(out.measure("surface_error") < 1e-8);
  }
}

TEST_CASE("weights are kept: a quarter of a cylinder") {
  const Folder folder;
  for (const char* format : kExact) {
    INFO(format);
    const auto out = stage(folder / "a.dat").set("format", format).run(quarter());
    CHECK(out.measure("area") == Approx(kPi / 2.0).epsilon(1e-6));
    CHECK(out.measure("border_length") == Approx(2.0 + kPi).epsilon(1e-6));
    CHECK(out.measure("surface_error") < 1e-8);
  }
}

TEST_CASE("the trimmed face has its loops as border curves, with corners") {
  const Folder folder;
  const double by_triangles = [&] {
    stage(folder / "a.ply").set("mesh_size", "0.01 m").run(trimmed());
    return area_under(read_mesh_file(folder / "a.ply"));
  }();
  for (const char* format : kExact) {
    INFO(format);
    const auto out = stage(folder / "a.dat").set("format", format).run(trimmed());
    CHECK(out.measure("loops") == 2);
    CHECK(out.measure("border_error") < 2e-5);
    CHECK(out.measure("area") == Approx(by_triangles).epsilon(1e-3));
  }
  stage(folder / "a.step").run(trimmed());
  CHECK(has(text_of(folder / "a.step"), "ADVANCED_FACE"));
}

TEST_CASE("the direction of the loops, a repeated last point and few points do not matter") {
  const Folder folder;
  const double area = stage(folder / "a.step").run(trimmed()).measure("area");
  Surface turned = trimmed();
  for (auto& loop : turned.trimming) {
    loop = loop.rowwise().reverse().eval();
    loop.conservativeResize(2, loop.cols() + 1);
    loop.col(loop.cols() - 1) = loop.col(0);
  }
  CHECK(stage(folder / "a.step").run(turned).measure("area") == Approx(area).epsilon(1e-6));
  Surface box = parabola();
  box.trimming = {(Eigen::Matrix2Xd(2, 4) << 0.0, 0.5, 0.5, 0.0, 0.0, 0.0, 1.0, 1.0).finished()};
  const double half = 0.5 * (1.0 * std::sqrt(1.64) + std::asinh(0.8) / 0.8);
  CHECK(stage(folder / "a.step").run(box).measure("area") == Approx(half).epsilon(1e-5));
}

TEST_CASE("a pole, where an edge of the surface is one point, is no obstacle") {
  const Folder folder;
  Surface s = parabola();
  for (const Index k : {1, 3, 5}) s.control.col(k) = Eigen::Vector3d(0.5, 1.0, 0.2);
  for (const char* format : kExact) {
    INFO(format);
    CHECK(stage(folder / "a.dat").set("format", format).run(s).measure("area") > 0.5);
    Surface cut = s;
    cut.trimming = {(Eigen::Matrix2Xd(2, 4) << 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0).finished()};
    CHECK(stage(folder / "b.dat").set("format", format).run(cut).measure("area") > 0.5);
  }
}

TEST_CASE("millimetres and AP214, said in the file, whatever the unit of meshes is") {
  const Folder folder;
  stage(folder / "a.step").set("units", "m").run(parabola());
  const std::string step = text_of(folder / "a.step");
  CHECK(has(step, "AUTOMOTIVE_DESIGN"));
  CHECK(has(step, "SI_UNIT(.MILLI.,.METRE.)"));
  CHECK(has(step, "CARTESIAN_POINT('',(2.E+03,"));
  stage(folder / "a.igs").set("units", "m").run(parabola());
  CHECK(has(text_of(folder / "a.igs"), "2HMM"));
  stage(folder / "a.stl").set("units", "mm").run(parabola());
  CHECK(read_mesh_file(folder / "a.stl").positions().row(0).maxCoeff() == Approx(2000.0F));
}

TEST_CASE("the same surface makes the same bytes") {
  const Folder folder;
  for (const char* format : kFormats) {
    INFO(format);
    stage(folder / "a.dat").set("format", format).run(trimmed());
    const std::string first = text_of(folder / "a.dat");
    stage(folder / "a.dat").set("format", format).threads(1).run(trimmed());
    CHECK(text_of(folder / "a.dat") == first);
  }
}

TEST_CASE("the extension chooses, an unknown one is refused") {
  const Folder folder;
  for (const char* name : {"a.step", "a.STP", "a.iges", "a.igs", "a.stl", "a.obj", "a.ply"})
    CHECK_NOTHROW(stage(folder / name).run(parabola()));
  CHECK_THROWS_AS(stage(folder / "a.pcd").run(parabola()), Error);
}

TEST_CASE("surfaces and loops that are not sound are refused by name, and leave no file") {
  const Folder folder;
  const auto refused = [&](const Surface& s) {
    for (const char* format : kFormats) {
      INFO(format);
      CHECK_THROWS_AS(stage(folder / "a.dat").set("format", format).run(s), Error);
    }
  };
  refused(Surface{});
  Surface short_knots = parabola();
  short_knots.knots_u.conservativeResize(4);
  refused(short_knots);
  Surface outside = parabola();
  outside.trimming = {circle({0.9, 0.5}, 0.3, 32)};
  refused(outside);
  Surface crossing = parabola();
  crossing.trimming = {
      (Eigen::Matrix2Xd(2, 4) << 0.1, 0.9, 0.1, 0.9, 0.1, 0.9, 0.95, 0.1).finished()};
  refused(crossing);
  CHECK(velum::formats::test::files_in(folder / "") == 0);
}

TEST_CASE("the true sail of a scene goes through both formats") {
  const Folder folder;
  const auto truth = Stage("devices.truth")
                         .set("scene", VELUM_SOURCE_DIR "/graphs/scenes/wind_tunnel.toml")
                         .set("object", "gennaker")
                         .run();
  for (const char* format : kExact) {
    const auto out = stage(folder / "a.dat").set("format", format).run(truth.get<Surface>());
    CHECK(out.measure("area") == Approx(truth.measure("area")).epsilon(1e-3));
  }
}

TEST_CASE("a full disk, a read-only folder and a kill leave no half file") {
  for (const char* format : kFormats) {
    INFO(format);
    for (const std::string& fault : velum::formats::test::writer_faults([&](const auto& path) {
           stage(path).set("format", format).threads(1).run(trimmed());
         }))
      FAIL_CHECK(fault);
  }
}

TEST_CASE("conformance") {
  for (const char* format : kFormats)
    for (const auto& fault :
         velum::test::conformance("io.write_surface", {{"file", "a.dat"}, {"format", format}}))
      FAIL_CHECK(format << ": " << fault);
}
