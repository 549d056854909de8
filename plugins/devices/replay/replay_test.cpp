// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <velum/testing.hpp>

#include "lms511/test_room.hpp"
#include "lms511/vrec.hpp"

using velum::Cloud;
using velum::Index;
using velum::test::Stage;
namespace fs = std::filesystem;
namespace device = velum::lms511;

namespace {

// A recording of the room, removed at the end.
struct Recording {
  fs::path path =
      fs::temp_directory_path() / ("velum_replay_" + std::to_string(::getpid()) + ".vrec");
  lms::RoomScan scan;
  Recording() {
    device::VrecWriter writer(path, {});
    scan.play([&](const device::Record& record) { writer.add(record); });
    writer.close();
  }
  ~Recording() { fs::remove(path); }
  [[nodiscard]] Stage stage() const {
    Stage stage("devices.replay");
    stage.set("file", path.string()).set("tilt", "constant");
    stage.set("tilt_start", "-0.5 rad").set("tilt_speed", "0.25 rad");
    return stage;
  }
};

// A plane z = a x + b y + c, fitted to the points within `band` of it, starting level at `height`.
struct Level {
  Eigen::Vector3d plane;
  Index count = 0;
  double rms = 0.0;
};
Level fit_level(const Cloud& cloud, double height, double band) {
  Level level{{0.0, 0.0, height}};
  for (int round = 0; round < 10; ++round) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    double squares = 0.0;
    level.count = 0;
    for (Index i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d p = cloud.positions().col(i).cast<double>();
      const Eigen::Vector3d row(p.x(), p.y(), 1.0);
      const double error = p.z() - row.dot(level.plane);
      if (std::abs(error) > band) continue;
      normal += row * row.transpose();
      right += row * p.z();
      squares += error * error;
      ++level.count;
    }
    level.rms = std::sqrt(squares / static_cast<double>(level.count));
    level.plane = normal.ldlt().solve(right);
  }
  return level;
}

// The most points within 5 cm of an upright plane of any direction.
Index largest_wall(const Cloud& cloud, double low, double high) {
  Index best = 0;
  for (int degree = 0; degree < 180; ++degree) {
    const double c = std::cos(degree * lms::kDegree);
    const double s = std::sin(degree * lms::kDegree);
    std::map<int, Index> bins;
    for (Index i = 0; i < cloud.size(); ++i) {
      const auto p = cloud.positions().col(i);
      if (p.z() < low || p.z() > high) continue;
      ++bins[static_cast<int>(std::floor((c * double{p.x()} + s * double{p.y()}) / 0.05))];
    }
    for (const auto& [bin, count] : bins) best = std::max(best, count);
  }
  return best;
}

}  // namespace

TEST_CASE("a recording becomes the room that was scanned") {
  const Recording recording;
  const auto outcome = recording.stage().run();
  const Cloud& cloud = outcome.cloud();
  REQUIRE(cloud.size() == 101 * 191);
  double worst = 0.0;
  for (Index i = 0; i < cloud.size(); ++i)
    worst = std::max(worst, recording.scan.room.error(cloud.positions().col(i).cast<double>()));
  CHECK(worst < 0.0006);
  CHECK(outcome.measure("lines") == 101);
  CHECK(outcome.measure("lost_lines") == 0);
  CHECK(outcome.measure("span") == Approx(4.0));
  CHECK(outcome.warnings.empty());
}

TEST_CASE("the pace does not change the cloud, and threads do not either") {
  const Recording recording;
  const auto once = hash_of(velum::Value(recording.stage().run().cloud()));
  CHECK(hash_of(velum::Value(recording.stage().set("pace", 40).run().cloud())) == once);
  CHECK(hash_of(velum::Value(recording.stage().threads(1).run().cloud())) == once);
}

TEST_CASE("a recording that was cut off is read up to the cut, with a warning") {
  const Recording recording;
  fs::resize_file(recording.path, fs::file_size(recording.path) - 100);
  const auto outcome = recording.stage().run();
  CHECK(outcome.cloud().size() > 0);
  REQUIRE(!outcome.warnings.empty());
  CHECK(outcome.warnings[0].find("not closed") != std::string::npos);
}

TEST_CASE("what is no recording is refused with the file's name") {
  const fs::path path = fs::temp_directory_path() / "velum_no_recording.bin";
  std::ofstream(path) << "this is text";
  try {
    static_cast<void>(Stage("devices.replay").set("file", path.string()).run());
    FAIL("replayed a text");
  } catch (const velum::Error& error) {
    CHECK(error.fault() == velum::Fault::input);
    CHECK(error.where() == path.string());
  }
  fs::remove(path);
}

TEST_CASE("points of the thesis's acquisition program get their tilt and range back") {
  const Recording recording;
  const Cloud swept = recording.stage().run().cloud();
  const fs::path path = fs::temp_directory_path() / "velum_acquisition.txt";
  {
    std::ofstream file(path);
    file.precision(10);
    for (Index i = 0; i < swept.size(); ++i)
      file << 1e3 * swept.positions()(0, i) << " " << 1e3 * swept.positions()(1, i) << " "
           << 1e3 * swept.positions()(2, i) << "\n";
  }
  const Cloud read =
      Stage("devices.replay").set("file", path.string()).set("units", "mm").run().cloud();
  REQUIRE(read.size() == swept.size());
  const auto differ = [&](const char* name, auto zero) {
    using T = decltype(zero);
    return static_cast<double>(
        (read.column(name).vector<T>() - swept.column(name).vector<T>()).cwiseAbs().maxCoeff());
  };
  CHECK(differ("tilt", 0.0F) < 2e-4);  // beams on the axis take that of the beam before
  CHECK(differ("range", 0.0F) < 1e-5);
  CHECK(differ("line", 0) == 0);
  CHECK(differ("beam", 0) == 0);
  fs::remove(path);
}

TEST_CASE("a tilt that lacks a parameter is a mistake in the graph") {
  const Recording recording;
  Stage stage("devices.replay");
  stage.set("file", recording.path.string()).set("tilt", "trapezoid").set("tilt_speed", 9);
  try {
    static_cast<void>(stage.run());
    FAIL("swept without an end");
  } catch (const velum::Error& error) {
    CHECK(error.fault() == velum::Fault::graph);
  }
  CHECK_THROWS_AS(recording.stage().set("misalignment", "[1, 2]").run(), velum::Error);
}

TEST_CASE("a real scanner turned by half a turn becomes a room") {
  const auto path = lms::capture("rotating_room_scan.txt");
  if (!path) {
    WARN("no captures at hand, skipped");
    return;
  }
  const auto outcome = Stage("devices.replay")
                           .set("file", path->string())
                           .set("tilt", "constant")
                           .set("tilt_end", 180)
                           .set("mounting", "turntable")
                           .run();
  const Cloud& cloud = outcome.cloud();
  CHECK(outcome.measure("lines") == 883);
  CHECK(outcome.measure("lost_lines") == 116);
  CHECK(outcome.measure("malformed") == 0);
  CHECK(outcome.measure("span") == Approx(19.992).margin(0.001));
  CHECK(cloud.size() == 503773 - 5486);
  const Level level = fit_level(cloud, 2.308, 0.03);
  WARN("level: " << level.count << " points, " << 1e3 * level.rms << " mm RMS, at "
                 << 1e3 * level.plane.z() << " mm");
  CHECK(level.count > 196000);
  CHECK(level.rms < 0.0085);
  CHECK(level.plane.z() == Approx(2.308).margin(0.01));
  const Index wall = largest_wall(cloud, -1.0, 2.0);
  WARN("largest wall: " << wall << " points within 5 cm");
  CHECK(wall > 15000);
}

TEST_CASE("a capture of a standing scanner becomes a cloud") {
  const auto path = lms::capture("20210301_lms511.device.bin");
  if (!path) {
    WARN("no captures at hand, skipped");
    return;
  }
  const auto outcome = Stage("devices.replay").set("file", path->string()).run();
  CHECK(outcome.measure("lines") == 135);  // the first was made with the laser off
  CHECK(outcome.cloud().size() == 135 * 1141 - static_cast<Index>(outcome.measure("no_return")));
  CHECK(outcome.cloud().positions().row(2).cwiseAbs().maxCoeff() == 0.0F);
}

TEST_CASE("devices.replay keeps the promises of every stage") {
  const Recording recording;
  for (const auto& fault : velum::test::conformance(
           "devices.replay", {{"file", recording.path.string()}, {"tilt", "fixed"}}))
    FAIL_CHECK(fault);
}
