// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <velum/testing.hpp>

#include "lms511/test_room.hpp"

using velum::Cloud;
using velum::Index;
using velum::test::Stage;
namespace device = velum::lms511;

namespace {

const char* const kRoom =
    "[{ normal = [1, 0, 0], point = [-3, 0, 0] }, { normal = [1, 0, 0], point = [4, 0, 0] }, "
    "{ normal = [0, 1, 0], point = [0, 5, 0] }, { normal = [0, 1, 0], point = [0, -2.5, 0] }, "
    "{ normal = [0, 0, 1], point = [0, 0, -1.2] }, { normal = [0, 0, 2], point = [0, 0, 1.8] }]";

lms::RoomScan mounted(device::Mounting mounting) {
  lms::RoomScan scan;
  scan.mounting = mounting;
  scan.calibration.lever = {0.02, -0.03, 0.05};
  scan.calibration.misalignment = {0.006, -0.008, 0.005};
  return scan;
}

Cloud made(const lms::RoomScan& scan, const device::Calibration& with = {}, double noise = 0.0) {
  device::LineGatherer lines;
  scan.play([&](const device::Record& record) { lines.add(record); });
  device::SweepSettings settings;
  settings.tilt = scan.tilt;
  settings.mounting = scan.mounting;
  settings.calibration = with;
  lms::QuietContext context;
  device::SweepCounts counts;
  const Cloud cloud = make_sweep(lines, settings, counts, context);
  if (noise == 0.0) return cloud;
  velum::Random random(3);
  velum::Points positions = cloud.positions();
  for (Index i = 0; i < positions.cols(); ++i)
    positions.col(i) *=
        static_cast<float>(1.0 + noise * random.gaussian() / positions.col(i).norm());
  return cloud.with_positions(std::move(positions));
}

double worst(const Cloud& cloud, const lms::Room& room) {
  double error = 0.0;
  for (Index i = 0; i < cloud.size(); ++i)
    error = std::max(error, room.error(cloud.positions().col(i).cast<double>()));
  return error;
}

}  // namespace

TEST_CASE("lever arm and misalignment are found, on a plate and on a turntable") {
  for (const auto mounting : {device::Mounting::plate, device::Mounting::turntable}) {
    const lms::RoomScan scan = mounted(mounting);
    const Cloud cloud = made(scan);
    REQUIRE(worst(cloud, scan.room) > 0.03);
    Stage stage("analysis.mounting");
    stage.set("planes", kRoom).set("tolerance", 0.15);
    stage.set("mounting", mounting == device::Mounting::plate ? "plate" : "turntable");
    const auto outcome = stage.run(cloud);
    CHECK(worst(outcome.cloud(), scan.room) < 0.001);
    const char* const levers[] = {"lever_x", "lever_y", "lever_z"};                      // NOLINT
    const char* const turns[] = {"misalignment_x", "misalignment_y", "misalignment_z"};  // NOLINT
    for (int i = 0; i < 3; ++i) {
      CHECK(outcome.measure(levers[i]) == Approx(scan.calibration.lever[i]).margin(1e-4));
      CHECK(outcome.measure(turns[i]) == Approx(scan.calibration.misalignment[i]).margin(5e-5));
    }
    CHECK(outcome.measure("rms") < 0.0004);
    CHECK(outcome.get<velum::Table>().size() == 6);
  }
}

TEST_CASE("with noise the deviations say how far off the figures are") {
  const lms::RoomScan scan = mounted(device::Mounting::plate);
  const auto outcome = Stage("analysis.mounting")
                           .set("planes", kRoom)
                           .set("tolerance", 0.15)
                           .run(made(scan, {}, 0.004));
  CHECK(outcome.measure("rms") == Approx(0.003).margin(0.001));
  const auto& table = outcome.get<velum::Table>();
  for (std::size_t row = 0; row < 3; ++row) {
    const double error =
        std::abs(table.number(row, "value") - scan.calibration.lever[static_cast<Index>(row)]);
    CHECK(error < 5.0 * table.number(row, "deviation"));
    CHECK(table.number(row, "deviation") < 0.0005);
  }
}

TEST_CASE("a cloud that was made with the right figures keeps them") {
  const lms::RoomScan scan = mounted(device::Mounting::plate);
  const auto outcome = Stage("analysis.mounting")
                           .set("planes", kRoom)
                           .set("lever_arm", "[0.02, -0.03, 0.05]")
                           .set("misalignment", R"(["0.006 rad", "-0.008 rad", "0.005 rad"])")
                           .run(made(scan, scan.calibration));
  CHECK(outcome.measure("lever_z") == Approx(0.05).margin(1e-4));
  CHECK(outcome.measure("misalignment_y") == Approx(-0.008).margin(5e-5));
}

TEST_CASE("what the planes do not tell is said, and stays as given") {
  // Floor and ceiling alone say nothing of a shift along the axis of a plate.
  const lms::RoomScan scan = mounted(device::Mounting::plate);
  const auto outcome =
      Stage("analysis.mounting")
          .set(
              "planes",
              "[{ normal = [0, 0, 1], point = [0, 0, -1.2] }, { normal = [0, 0, 1], point = [0, 0, "
              "1.8] }]")
          .run(made(scan));
  REQUIRE(!outcome.warnings.empty());
  CHECK(outcome.warnings.front().find("lever_x") != std::string::npos);
  CHECK(outcome.measure("lever_x") == Approx(0.0).margin(1e-6));
}

TEST_CASE("planes that nothing is near, and none at all, are refused") {
  const Cloud cloud = made(mounted(device::Mounting::plate));
  CHECK_THROWS_AS(Stage("analysis.mounting")
                      .set("planes", "[{ normal = [0, 0, 1], point = [0, 0, 50] }]")
                      .run(cloud),
                  velum::Error);
  CHECK_THROWS_AS(Stage("analysis.mounting").run(cloud), velum::Error);
  CHECK_THROWS_AS(Stage("analysis.mounting")
                      .set("planes", "[{ normal = [0, 0, 0], point = [0, 0, 50] }]")
                      .run(cloud),
                  velum::Error);
}

TEST_CASE("analysis.mounting keeps the promises of every stage") {
  for (const auto& fault : velum::test::conformance("analysis.mounting", {{"planes", kRoom}}))
    FAIL_CHECK(fault);
}
