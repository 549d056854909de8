// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Index;
using velum::test::Stage;

namespace {

const std::string kTunnel = std::string(VELUM_SOURCE_DIR) + "/graphs/scenes/wind_tunnel.toml";
const std::string kField = std::string(VELUM_SOURCE_DIR) + "/graphs/scenes/on_field.toml";

Stage simulator(const std::string& scene, const std::string& scanner, double step = 1.0) {
  Stage stage("devices.simulator");
  stage.set("scene", scene).set("scanner", scanner).set("beam_step", step).set("tilt_step", step);
  return stage;
}

std::map<int, Index> labels(const Cloud& cloud) {
  std::map<int, Index> count;
  for (const int label : cloud.labels()) ++count[label];
  return count;
}

}  // namespace

TEST_CASE("the tunnel surrounds the scanner, so every beam returns") {
  const auto outcome = simulator(kTunnel, "gennaker").run();
  CHECK(outcome.cloud().size() == 191 * 51);
  for (const char* name : {"label", "beam", "line", "tilt", "sensor"})
    CHECK(outcome.cloud().has(name));
  REQUIRE(outcome.cloud().sensors().size() == 1);
  CHECK(outcome.cloud().sensors().front().name == "gennaker");
  CHECK(outcome.cloud().origin().isZero());
}

TEST_CASE("each sail is seen by the scanner that is meant for it") {
  const auto gennaker = labels(simulator(kTunnel, "gennaker", 0.5).run().cloud());
  CHECK(gennaker.at(11) > 2000);
  const auto mainsail = labels(simulator(kTunnel, "mainsail", 0.5).run().cloud());
  CHECK(mainsail.at(10) > 1200);
  // Both see floor, ceiling, a side and an end: planes in three directions to register by.
  for (const int part : {1, 2, 4, 6}) {
    CHECK(gennaker.at(part) > 1000);
    CHECK(mainsail.at(part) > 300);
  }
}

TEST_CASE("on the water there is no background") {
  const auto outcome = simulator(kField, "mast").run();
  CHECK(outcome.cloud().size() < 191 * 126 / 2);
  for (const auto& [label, count] : labels(outcome.cloud())) CHECK(label <= 11);
  CHECK(labels(outcome.cloud()).at(11) > 1000);
}

TEST_CASE("range noise is as asked for") {
  const Cloud clean = simulator(kTunnel, "gennaker").set("noise", "0 mm").run().cloud();
  const Cloud noisy = simulator(kTunnel, "gennaker").set("noise", "4 mm").run().cloud();
  REQUIRE(clean.size() == noisy.size());
  double squares = 0.0;
  for (Index i = 0; i < clean.size(); ++i) {
    const Eigen::Vector3d a = clean.positions().col(i).cast<double>();
    const Eigen::Vector3d b = noisy.positions().col(i).cast<double>();
    squares += std::pow(b.norm() - a.norm(), 2);
    CHECK(a.cross(b).norm() < 1e-4);  // noise acts along the ray
  }
  CHECK(std::sqrt(squares / static_cast<double>(clean.size())) == Approx(0.004).epsilon(0.05));
}

TEST_CASE("the same seed gives the same scan, another seed another") {
  const auto one = hash_of(velum::Value(simulator(kTunnel, "gennaker").seed(3).run().cloud()));
  const auto same =
      hash_of(velum::Value(simulator(kTunnel, "gennaker").seed(3).threads(1).run().cloud()));
  const auto other = hash_of(velum::Value(simulator(kTunnel, "gennaker").seed(4).run().cloud()));
  CHECK(one == same);
  CHECK(one != other);
}

TEST_CASE("mixed pixels are labelled, and come only when asked for") {
  const auto plain = labels(simulator(kTunnel, "gennaker").run().cloud());
  CHECK(plain.count(-1) == 0);
  const auto mixed =
      labels(simulator(kTunnel, "gennaker").set("mixed_pixels", "true").run().cloud());
  CHECK(mixed.at(-1) > 20);
}

TEST_CASE("a finer beam step gives proportionally more points") {
  const Index coarse = simulator(kTunnel, "gennaker", 1.0).run().cloud().size();
  const Index fine = simulator(kTunnel, "gennaker", 0.5).run().cloud().size();
  CHECK(static_cast<double>(fine) / static_cast<double>(coarse) == Approx(4.0).epsilon(0.02));
}

TEST_CASE("effects are chosen in the graph, and their names are checked before anything runs") {
  const auto range = [](const char* errors) {
    const Cloud cloud =
        simulator(kTunnel, "gennaker").set("noise", "0 mm").set("errors", errors).run().cloud();
    return static_cast<double>(cloud.positions().col(0).norm());
  };
  const double plain = range("none");
  CHECK(range("distance") - plain == Approx(0.0034 + 0.001 * plain).margin(1e-5));
  CHECK_THROWS_AS(simulator(kTunnel, "gennaker").set("errors", "rain").run(), velum::Error);
}

TEST_CASE("repeated lines have numbers and times of their own") {
  const Cloud cloud = simulator(kTunnel, "gennaker")
                          .set("repeats", "3")
                          .set("period", "20 ms")
                          .set("tilt_step", "25 deg")
                          .run()
                          .cloud();
  CHECK(cloud.size() == 3 * 3 * 191);
  const auto lines = cloud.column("line").vector<std::int32_t>();
  const auto times = cloud.column("time").vector<double>();
  const auto tilts = cloud.column("tilt").vector<float>();
  CHECK(lines[cloud.size() - 1] == 8);
  CHECK(tilts[0] == tilts[3 * 191 - 1]);
  CHECK(tilts[0] < tilts[3 * 191]);
  CHECK(times[191] == Approx(0.02));
  CHECK(times[190] == Approx(0.02 * 190.0 / 360.0));  // a beam a degree, 360 a revolution
}

TEST_CASE("a scanner that the scene does not have is a mistake in the graph") {
  try {
    static_cast<void>(simulator(kTunnel, "bow").run());
    FAIL("scanned with a scanner that does not exist");
  } catch (const velum::Error& error) {
    CHECK(error.fault() == velum::Fault::graph);
    CHECK(error.hint() == "known: gennaker, mainsail");
  }
}

TEST_CASE("a scene with a mistake is refused with its place") {
  const auto path = std::filesystem::temp_directory_path() / "velum_bad_scene.toml";
  std::ofstream(path) << "format = 1\nunits = \"m\"\n[scanner.a]\nnoise = true\n";
  try {
    static_cast<void>(simulator(path.string(), "a").run());
    FAIL("read a scene that is wrong");
  } catch (const velum::Error& error) {
    CHECK(error.fault() == velum::Fault::input);
    CHECK(error.where() == path.string() + ":4:9");
  }
  std::filesystem::remove(path);
}

TEST_CASE("devices.simulator keeps the promises of every stage") {
  for (const auto& fault :
       velum::test::conformance("devices.simulator", {{"scene", kTunnel}, {"scanner", "gennaker"}}))
    FAIL_CHECK(fault);
}
