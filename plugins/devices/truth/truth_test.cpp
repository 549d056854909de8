// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <numbers>
#include <velum/testing.hpp>

using velum::Index;
using velum::Mesh;
using velum::Surface;
using velum::Table;
using velum::Transform;
using velum::test::Outcome;
using velum::test::Stage;

namespace {

const std::string kTunnel = std::string(VELUM_SOURCE_DIR) + "/graphs/scenes/wind_tunnel.toml";

Stage truth() {
  Stage stage("devices.truth");
  stage.set("scene", kTunnel);
  return stage;
}

double area(const Mesh& mesh) {
  double sum = 0.0;
  for (Index i = 0; i < mesh.size(); ++i) {
    const Eigen::Vector3d a = mesh.positions().col(mesh.triangles()(0, i)).cast<double>();
    const Eigen::Vector3d b = mesh.positions().col(mesh.triangles()(1, i)).cast<double>();
    const Eigen::Vector3d c = mesh.positions().col(mesh.triangles()(2, i)).cast<double>();
    sum += 0.5 * (b - a).cross(c - a).norm();
  }
  return sum;
}

bool made(const Outcome& outcome, std::size_t output) {
  return outcome.results.at(output).has_value();
}

}  // namespace

TEST_CASE("a sail has mesh, surface and sections, a scanner its pose") {
  const Outcome sail = truth().set("object", "gennaker").run();
  CHECK(made(sail, 0));
  CHECK(made(sail, 1));
  CHECK_FALSE(made(sail, 2));
  CHECK(made(sail, 3));
  const Outcome hull = truth().set("object", "hull").run();
  CHECK(made(hull, 0));
  CHECK_FALSE(made(hull, 1));
  CHECK_FALSE(made(hull, 3));
  const Outcome scanner = truth().set("scanner", "mainsail").run();
  CHECK_FALSE(made(scanner, 0));
  CHECK(made(scanner, 2));
  CHECK(scanner.get<Transform>().source == "mainsail");
  CHECK(scanner.get<Transform>().target == "scene");
}

TEST_CASE("sections are those of the scene file") {
  const Outcome sail = truth().set("object", "gennaker").set("heights", "[0, 0.25, 0.5]").run();
  const Table& table = sail.get<Table>();
  REQUIRE(table.size() == 3);
  CHECK(table.number(1, "chord") == Approx(1.14));
  CHECK(table.number(1, "camber") == Approx(18.0));
  CHECK(table.number(1, "draft") == Approx(47.0));
  CHECK(table.number(2, "twist") == Approx(10.0));
  CHECK(table.number(0, "z") == Approx(0.40));
  CHECK(table.headings()[3].unit == "%");
}

TEST_CASE("twist counts from the lowest height that is asked for") {
  const Outcome sail = truth().set("object", "gennaker").set("heights", "[0.5, 0.25]").run();
  CHECK(sail.get<Table>().number(0, "twist") == Approx(5.0));
  CHECK(sail.get<Table>().number(1, "twist") == Approx(0.0));
}

TEST_CASE("the mesh has the sail's area and is smooth enough to compare with") {
  const Outcome sail = truth().set("object", "mainsail").run();
  CHECK(area(sail.mesh()) == Approx(sail.measure("area")).epsilon(1e-4));
  CHECK(sail.mesh().size() > 4000);
  CHECK(sail.mesh().size() < 200000);
}

TEST_CASE("the frame of a scanner moves mesh, surface and sections alike") {
  const Outcome scene = truth().set("object", "gennaker").run();
  const Outcome own = truth().set("object", "gennaker").set("frame", "mainsail").run();
  const velum::Pose pose = truth().set("scanner", "mainsail").run().get<Transform>().matrix;
  for (const Index i : {Index{0}, Index{100}, Index{2000}}) {
    const Eigen::Vector3d a = own.mesh().origin() + own.mesh().positions().col(i).cast<double>();
    const Eigen::Vector3d b =
        scene.mesh().origin() + scene.mesh().positions().col(i).cast<double>();
    CHECK((pose * a - b).norm() < 1e-6);
  }
  const Eigen::Vector3d u = own.get<Surface>().control.col(0);
  const Eigen::Vector3d v = scene.get<Surface>().control.col(0);
  CHECK((pose * u - v).norm() < 1e-9);
  CHECK(own.get<Table>().number(0, "camber") == scene.get<Table>().number(0, "camber"));
}

TEST_CASE("a scanner's transform takes its scan to the other scanner's frame") {
  const Outcome both = truth().set("scanner", "mainsail").set("frame", "gennaker").run();
  const Outcome back = truth().set("scanner", "gennaker").set("frame", "mainsail").run();
  const auto& there = both.get<Transform>();
  CHECK(there.source == "mainsail");
  CHECK(there.target == "gennaker");
  CHECK((there.matrix * back.get<Transform>().matrix).isApprox(velum::Pose::Identity(), 1e-12));
}

TEST_CASE("scanned points lie on the object that they are labelled with") {
  Stage simulator("devices.simulator");
  const velum::Cloud cloud = simulator.set("scene", kTunnel)
                                 .set("scanner", "gennaker")
                                 .set("noise", "0 mm")
                                 .set("beam_step", 1.0)
                                 .set("tilt_step", 1.0)
                                 .run()
                                 .cloud();
  const Outcome sail = truth().set("object", "gennaker").set("frame", "gennaker").run();
  const velum::Cloud vertices = sail.mesh().vertices();
  // Farther from the nearest vertex than a cell's side (2 cm) none may be.
  Index on_sail = 0;
  for (Index i = 0; i < cloud.size(); ++i) {
    if (cloud.labels()[i] != 11) continue;
    const Eigen::Vector3d at = cloud.positions().col(i).cast<double>() - vertices.origin();
    CHECK(vertices.neighbours().nearest_one(at.cast<float>(), 0.04).index >= 0);
    ++on_sail;
  }
  CHECK(on_sail > 500);
}

TEST_CASE("what is not asked for properly is a mistake in the graph") {
  CHECK_THROWS_AS(truth().run(), velum::Error);
  CHECK_THROWS_AS(truth().set("object", "hull").set("scanner", "gennaker").run(), velum::Error);
  CHECK_THROWS_AS(truth().set("object", "keel").run(), velum::Error);
  CHECK_THROWS_AS(truth().set("object", "hull").set("frame", "keel").run(), velum::Error);
}

TEST_CASE("devices.truth keeps the promises of every stage") {
  for (const auto& fault :
       velum::test::conformance("devices.truth", {{"scene", kTunnel}, {"object", "gennaker"}}))
    FAIL_CHECK(fault);
}
