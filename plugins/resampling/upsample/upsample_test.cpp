// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <velum/testing.hpp>

#include "mesh/distance.hpp"
#include "mesh/topology.hpp"
#include "smoothing/test_sheet.hpp"

using velum::Cloud;
using velum::Index;
using velum::Mesh;
using velum::Points;
using velum::test::bent_sheet;
using velum::test::sheet_error;
using velum::test::Stage;

namespace {

Stage stage(const char* spacing = "8 mm") {
  Stage made("resampling.upsample");
  made.set("spacing", spacing);
  return made;
}

// Distance from `at` to the nearest point of a cloud.
double gap_at(const Cloud& cloud, double x, double y, double z) {
  const Eigen::Vector3f at = Eigen::Vector3d(x, y, z).cast<float>();
  return std::sqrt(static_cast<double>(cloud.neighbours().nearest_one(at, 10.0).distance2));
}

// The part of a cloud whose points `keep` wants.
template <class Keep>
Cloud part(const Cloud& cloud, const Keep& keep) {
  std::vector<std::int32_t> kept;
  for (Index i = 0; i < cloud.size(); ++i)
    if (keep(cloud.positions().col(i))) kept.push_back(static_cast<std::int32_t>(i));
  return cloud.select(kept);
}

std::string scene() {
  return "\"" VELUM_SOURCE_DIR "/graphs/scenes/wind_tunnel.toml\"";
}

}  // namespace

TEST_CASE("every place inside has a point within the spacing") {
  const auto out = stage().run(bent_sheet(2.0, 0.0));
  for (double x = 0.02; x < 0.78; x += 0.0037)
    for (double y = 0.02; y < 0.78; y += 0.0041)
      REQUIRE(gap_at(out.cloud(), x, y, x * x / 4.0) < 0.008);
  CHECK(out.measure("made") > 5000.0);
  CHECK(out.measure("points") == static_cast<double>(out.cloud().size()));
}

TEST_CASE("new points are apart from each other and from those given") {
  const Cloud out = stage().run(bent_sheet(2.0, 0.0)).cloud();
  std::vector<velum::Neighbour> found;
  for (Index i = 41 * 41; i < out.size(); ++i) {
    out.neighbours().nearest(out.positions().col(i), 2, found);
    REQUIRE(std::sqrt(found[1].distance2) > 0.65F * 0.008F);
  }
}

TEST_CASE("new points lie on the bent surface") {
  const Cloud out = stage().run(bent_sheet(1.0, 0.0)).cloud();
  CHECK(sheet_error(out, 1.0, 0.0) < 1e-4);
}

TEST_CASE("points given stay, first and in their order, and new ones are marked") {
  const Cloud in = bent_sheet(2.0, 0.004);
  const Cloud out = stage().run(in).cloud();
  CHECK(out.positions().leftCols(in.size()) == in.positions());
  const auto made = out.column("made").vector<std::uint8_t>();
  CHECK(made.head(in.size()).maxCoeff() == 0);
  CHECK(made.tail(out.size() - in.size()).minCoeff() == 1);
}

TEST_CASE("new points carry less noise than those given") {
  const Cloud in = bent_sheet(2.0, 0.002);
  const Cloud out = stage().set("radius", "100 mm").run(in).cloud();
  std::vector<std::int32_t> fresh;
  for (Index i = in.size(); i < out.size(); ++i) fresh.push_back(static_cast<std::int32_t>(i));
  CHECK(sheet_error(out.select(fresh), 2.0, 0.1) < 0.3 * 0.002);
}

TEST_CASE("nothing is made past a straight border") {
  const Cloud out = stage().run(bent_sheet(2.0, 0.0)).cloud();
  CHECK(out.positions().topRows(2).minCoeff() > -1e-4F);
  CHECK(out.positions().topRows(2).maxCoeff() < 0.8001F);
}

TEST_CASE("nor past a hollow one, by more than the reach allows") {
  // A bay with a radius of 0.3 m in the side x = 0.8.
  const Eigen::Vector2f middle(0.9F, 0.4F);
  const Cloud in = part(bent_sheet(1e9, 0.0), [&](const auto& p) {
    return (p.template head<2>() - middle).norm() > 0.3F;
  });
  const Cloud out = stage().run(in).cloud();
  for (Index i = in.size(); i < out.size(); ++i)
    REQUIRE((out.positions().col(i).head<2>() - middle).norm() > 0.295F);
}

TEST_CASE("holes wider than the reach stay open, others are filled") {
  const Cloud in = part(bent_sheet(1e9, 0.0), [](const auto& p) {
    const Eigen::Vector2f q = p.template head<2>();
    return (q - Eigen::Vector2f(0.2F, 0.2F)).norm() > 0.15F &&
           (q - Eigen::Vector2f(0.6F, 0.6F)).norm() > 0.025F;
  });
  const Cloud out = stage().set("reach", "80 mm").run(in).cloud();
  CHECK(gap_at(out, 0.2, 0.2, 0.0) > 0.1);
  CHECK(gap_at(out, 0.6, 0.6, 0.0) < 0.01);
}

TEST_CASE("a sail is filled, and nowhere past its edge") {
  const auto scan = Stage("devices.simulator")
                        .set("scene", scene())
                        .set("scanner", "gennaker")
                        .set("beam_step", "0.5 deg")
                        .set("tilt_step", "0.5 deg")
                        .set("noise", 0.0)
                        .run();
  std::vector<std::int32_t> sail;
  for (Index i = 0; i < scan.cloud().size(); ++i)
    if (scan.cloud().labels()[i] == 11) sail.push_back(static_cast<std::int32_t>(i));
  const Cloud in = scan.cloud().select(sail);
  const Cloud out = stage("10 mm").run(in).cloud();
  REQUIRE(out.size() > 4 * in.size());
  const Mesh made = Stage("devices.truth")
                        .set("scene", scene())
                        .set("object", "gennaker")
                        .set("frame", "gennaker")
                        .run()
                        .mesh();
  const Mesh truth = made.with_vertices(made.vertices().with_origin(out.origin()));
  const velum::mesh::DistanceTree tree(truth);
  // Past the edge the distance to the sail grows with every step. The head, 50 mm wide and bent
  // with a radius of as much, is too narrow for the fit.
  const float head = in.positions().row(2).maxCoeff() - 0.15F;
  double squares = 0.0, count = 0.0;
  for (Index i = in.size(); i < out.size(); ++i) {
    const Eigen::Vector3d p = out.positions().col(i).cast<double>();
    const double distance = std::sqrt(tree.closest(p).distance2);
    squares += distance * distance;
    count += 1.0;
    if (p.z() < static_cast<double>(head)) REQUIRE(distance < 0.002);
  }
  CHECK(std::sqrt(squares / count) < 0.0005);
}

TEST_CASE("normals look at the sensor and other columns come from the nearest point") {
  Cloud in = bent_sheet(2.0, 0.0);
  Eigen::VectorXi label(in.size());
  for (Index i = 0; i < in.size(); ++i) label[i] = in.positions()(0, i) < 0.41F ? 1 : 2;
  const Cloud out = stage().run(in.with("label", velum::Column(label))).cloud();
  for (Index i = 0; i < out.size(); ++i) {
    REQUIRE(out.normals()(2, i) > 0.8F);
    if (std::abs(out.positions()(0, i) - 0.41F) > 0.012F)
      REQUIRE(out.labels()[i] == (out.positions()(0, i) < 0.41F ? 1 : 2));
  }
  CHECK(out.sensors().size() == 1);
}

TEST_CASE("a cloud that is dense enough gets nothing") {
  const Cloud in = bent_sheet(2.0, 0.0);
  CHECK(stage("50 mm").run(in).cloud().size() == in.size());
}

TEST_CASE("a spacing out of all proportion is refused") {
  CHECK_THROWS_WITH(stage("1e-6 m").run(bent_sheet(2.0, 0.0)), Catch::Contains("300 million"));
  CHECK_THROWS_AS(Stage("resampling.upsample").run(bent_sheet(2.0, 0.0)), velum::Error);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("resampling.upsample", {{"spacing", "0.05"}}))
    FAIL_CHECK(fault);
}
