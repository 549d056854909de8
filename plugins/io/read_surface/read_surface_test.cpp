// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Circ.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Pln.hxx>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "bspline/evaluate.hpp"
#include "bspline/tessellate.hpp"
#include "cad/library.hpp"
#include "formats/test_stages.hpp"

using velum::Error;
using velum::Fault;
using velum::Index;
using velum::Surface;
using velum::formats::test::fault_of;
using velum::formats::test::Folder;
using velum::formats::test::put;
using velum::formats::test::stage_on;
using velum::formats::test::text_of;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr const char* kFormats[] = {"a.step", "a.igs"};

/// z = 0.4 x² over the square [0, 2] × [0, 1] m.
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

/// Two straight sides and a hollow one, with a round hole, far from zero.
Surface trimmed() {
  Surface s = parabola();
  s.origin << 2000.0, -20.0, 5.0;
  Eigen::Matrix2Xd outer(2, 42);
  for (int i = 0; i <= 40; ++i) {
    const double t = i / 40.0;
    outer.col(i) << 0.9 - 0.8 * t - 0.3 * t * (1.0 - t), 0.1 + 0.8 * t;
  }
  outer.col(41) << 0.1, 0.1;
  Eigen::Matrix2Xd hole(2, 48);
  for (int i = 0; i < 48; ++i)
    hole.col(i) << 0.25 + 0.08 * std::cos(kPi * i / 24), 0.35 + 0.08 * std::sin(kPi * i / 24);
  s.trimming = {outer, hole};
  return s;
}

Surface read(const std::filesystem::path& file) {
  return stage_on("io.read_surface", file).run().get<Surface>();
}

Surface there_and_back(const Surface& surface, const char* name) {
  const Folder folder;
  stage_on("io.write_surface", folder / name).run(surface);
  return read(folder / name);
}

double area_of(const Surface& surface) {
  velum::run::LocalContext context(1, 1);
  const velum::Mesh mesh = velum::bspline::tessellate(surface, 0.01, context).mesh;
  double area = 0.0;
  for (Index i = 0; i < mesh.size(); ++i) {
    const auto p = [&](Index c) {
      return Eigen::Vector3d(mesh.positions().col(mesh.triangles()(c, i)).cast<double>());
    };
    area += 0.5 * (p(1) - p(0)).cross(p(2) - p(0)).norm();
  }
  return area;
}

/// The greatest distance between both at one share of their ranges [m].
double distance(const Surface& a, const Surface& b) {
  const velum::bspline::Patch p(a);
  const velum::bspline::Patch q(b);
  double worst = 0.0;
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 8; ++j) {
      const Eigen::Vector2d share(i / 8.0, j / 8.0);
      const auto at = [&](const velum::bspline::Patch& patch) {
        return Eigen::Vector3d(
            patch.at(patch.low() + share.cwiseProduct(patch.high() - patch.low())) +
            patch.surface().origin);
      };
      worst = std::max(worst, (at(p) - at(q)).norm());
    }
  return worst;
}

std::filesystem::path file_of(const Folder& folder, const TopoDS_Shape& shape) {
  velum::cad::guarded(Fault::output, "test", [&] {
    velum::cad::write_shape(shape, velum::cad::Exchange::step, folder / "a.step", "a");
  });
  return folder / "a.step";
}

}  // namespace

TEST_CASE("a surface comes back from STEP and IGES, in metres and without loops") {
  for (const char* name : kFormats) {
    INFO(name);
    const Surface back = there_and_back(parabola(), name);
    CHECK(back.degree_u == 2);
    CHECK(back.degree_v == 1);
    CHECK(back.control.isApprox(parabola().control, 1e-12));
    CHECK(back.weights.size() == 0);
    CHECK(back.trimming.empty());
    CHECK(back.origin.isZero(0.0));
  }
}

TEST_CASE("weights come back") {
  for (const char* name : kFormats) {
    INFO(name);
    const Surface back = there_and_back(quarter(), name);
    CHECK(distance(back, quarter()) < 1e-9);
    CHECK(back.weights.size() == 6);
  }
}

TEST_CASE("trimming loops come back within the tolerance, large coordinates keep their digits") {
  const double area = area_of(trimmed());
  for (const char* name : kFormats) {
    INFO(name);
    const Surface back = there_and_back(trimmed(), name);
    REQUIRE(back.trimming.size() == 2);
    CHECK(distance(back, trimmed()) < 1e-8);
    CHECK(std::abs(back.origin.x() - 2000.0) < 10.0);
    CHECK(area_of(back) == Approx(area).epsilon(1e-3));
    CHECK(velum::bspline::inside(back.trimming, {0.2, 0.7}));
    CHECK_FALSE(velum::bspline::inside(back.trimming, {0.25, 0.35}));
  }
}

TEST_CASE("written, read and written again, area and borders stay") {
  const Folder folder;
  const auto first = stage_on("io.write_surface", folder / "a.step").run(trimmed());
  const auto again = stage_on("io.write_surface", folder / "b.step").run(read(folder / "a.step"));
  CHECK(again.measure("loops") == 2);
  CHECK(again.measure("area") == Approx(first.measure("area")).epsilon(1e-4));
  CHECK(again.measure("border_length") == Approx(first.measure("border_length")).epsilon(1e-4));
}

TEST_CASE("a plane and a cylinder of a CAD program become B-splines of the same shape") {
  const Folder folder;
  const TopoDS_Wire circle =
      BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(gp::XOY(), 500.0)).Edge()).Wire();
  const TopoDS_Face disc = BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), circle).Face();
  const Surface plane = read(file_of(folder, disc));
  CHECK(plane.trimming.size() == 1);
  CHECK(area_of(plane) == Approx(kPi * 0.25).epsilon(1e-3));
  const TopoDS_Face half =
      BRepBuilderAPI_MakeFace(gp_Cylinder(gp::XOY(), 1000.0), 0.0, kPi, 0.0, 2000.0).Face();
  const Surface cylinder = read(file_of(folder, half));
  CHECK(cylinder.weights.size() > 0);
  CHECK(area_of(cylinder) == Approx(2.0 * kPi).epsilon(1e-3));
  const velum::bspline::Patch patch(cylinder);
  CHECK(patch.at(0.5 * (patch.low() + patch.high())).head<2>().norm() == Approx(1.0));
}

TEST_CASE("other than one face is refused with what was found") {
  const Folder folder;
  stage_on("io.write_surface", folder / "a.step").run(parabola());
  std::string text = text_of(folder / "a.step");
  const std::size_t data = text.find("DATA;");
  const auto why = [&](const std::string& content) -> std::string {
    try {
      read(put(folder, "b.step", content));
    } catch (const Error& error) {
      CHECK(error.fault() == Fault::input);
      return error.what();
    }
    return "";
  };
  const std::string none = text.substr(0, data) + "DATA;\nENDSEC;\nEND-ISO-10303-21;\n";
  CHECK(why(none).find("OpenCASCADE finds no shape") != std::string::npos);
  CHECK(why(text.substr(0, text.size() - 30)).find("not whole") != std::string::npos);
  CHECK(why("solid a\nendsolid a\n").find("neither as STEP") != std::string::npos);
  BRep_Builder builder;
  TopoDS_Compound two;
  builder.MakeCompound(two);
  for (const double z : {0.0, 100.0})
    builder.Add(two, BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 0, z), gp::DZ()), 0, 1, 0, 1).Face());
  CHECK(why(text_of(file_of(folder, two))).find("0 solids, 2 faces, 8 edges, expected one face") !=
        std::string::npos);
}

TEST_CASE("files that end early or have other bytes are read or refused, never more") {
  const Folder folder;
  stage_on("io.write_surface", folder / "a.step").run(parabola());
  const std::string good = text_of(folder / "a.step");
  for (std::size_t at = 20; at + 20 < good.size(); at += good.size() / 12) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] == '#' ? '!' : bad[at] ^ 0x05);
    INFO(at);
    try {
      static_cast<void>(read(put(folder, "b.step", bad)));
    } catch (const Error& error) {
      // OpenCASCADE may crash, in a process of its own: a fault of the stage.
      CHECK((error.fault() == Fault::input || error.fault() == Fault::stage));
    }
  }
}

TEST_CASE("a missing or empty file is refused") {
  const Folder folder;
  CHECK_THROWS_AS(read(folder / "missing.step"), Error);
  CHECK(fault_of(stage_on("io.read_surface", put(folder, "a.step", ""))) == Fault::input);
}

TEST_CASE("conformance") {
  const Folder folder;
  stage_on("io.write_surface", folder / "a.step").run(parabola());
  for (const auto& fault :
       velum::test::conformance("io.read_surface", {{"file", (folder / "a.step").string()}}))
    FAIL_CHECK(fault);
}
