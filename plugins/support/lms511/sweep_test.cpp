// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "lms511/sweep.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "lms511/test_room.hpp"

using namespace velum::lms511;  // NOLINT
using lms::RoomScan;

namespace {

LineGatherer gathered(const RoomScan& scan) {
  LineGatherer lines;
  scan.play([&](const Record& record) { lines.add(record); });
  return lines;
}

velum::Cloud swept(const LineGatherer& lines, const SweepSettings& settings) {
  lms::QuietContext context;
  SweepCounts counts;
  velum::Cloud cloud = make_sweep(lines, settings, counts, context);
  CHECK(counts.untilted == 0);
  return cloud;
}

// The farthest that any point is from the room's walls [m].
double worst(const velum::Cloud& cloud, const lms::Room& room) {
  double error = 0.0;
  for (velum::Index i = 0; i < cloud.size(); ++i)
    error = std::max(error, room.error(cloud.positions().col(i).cast<double>()));
  return error;
}

constexpr double kMillimetre = 0.0006;  // half of what telegrams can tell, and single precision

}  // namespace

TEST_CASE("every beam has the tilt of its own time") {
  const RoomScan scan;
  const LineGatherer lines = gathered(scan);
  CHECK(lines.counts().lines == 101);
  CHECK(lines.counts().lost == 0);
  SweepSettings settings;
  settings.tilt = scan.tilt;
  const velum::Cloud cloud = swept(lines, settings);
  REQUIRE(cloud.size() == 101 * 191);
  CHECK(worst(cloud, scan.room) < kMillimetre);
  for (const char* name : {"beam", "line", "tilt", "time", "range", "sensor", "intensity"})
    CHECK(cloud.has(name));
  CHECK_FALSE(cloud.has("echo"));
  const auto tilt = cloud.column("tilt").vector<float>();
  CHECK(tilt[0] == Approx(-0.5));
  CHECK(tilt[190] == Approx(-0.5 + 0.25 * 0.04 * 190.0 / 360.0).margin(1e-5));
  // One tilt for a whole line would be wrong by far more.
  settings.tilt.start += 0.25 * 0.5 * 0.04 * 190.0 / 360.0;
  CHECK(worst(swept(lines, settings), scan.room) > 4 * kMillimetre);
}

TEST_CASE("lever arm, misalignment, time offset and a turntable are undone") {
  RoomScan scan;
  scan.calibration.lever = {0.05, -0.03, 0.12};
  scan.calibration.misalignment = {0.01, -0.02, 0.015};
  scan.calibration.time_offset = 0.0016;
  for (const Mounting mounting : {Mounting::plate, Mounting::turntable}) {
    scan.mounting = mounting;
    SweepSettings settings;
    settings.tilt = scan.tilt;
    settings.mounting = mounting;
    const LineGatherer lines = gathered(scan);
    CHECK(worst(swept(lines, settings), scan.room) > 0.01);
    settings.calibration = scan.calibration;
    settings.calibration.time_offset = 0.0;  // the law begins with the first line
    settings.tilt.start += 0.25 * scan.calibration.time_offset;
    const velum::Cloud cloud = swept(lines, settings);
    CHECK(worst(cloud, scan.room) < kMillimetre);
    CHECK(cloud.sensors().at(0).pose.translation().norm() ==
          Approx(scan.calibration.lever.norm()).epsilon(1e-6));
  }
}

TEST_CASE("the trapezoidal law gains and loses speed evenly") {
  RoomScan scan;
  scan.tilt = {.source = TiltSource::trapezoid,
               .start = 0.6,
               .end = -0.6,
               .speed = 0.5,
               .acceleration = 0.4};
  CHECK(*scan.tilt.duration() == Approx(1.2 / 0.5 + 0.5 / 0.4));
  const TiltCurve curve(scan.tilt, 0.0);
  CHECK(*curve.at(-1.0) == 0.6);
  CHECK(*curve.at(0.5) == Approx(0.6 - 0.5 * 0.4 * 0.25));
  CHECK(*curve.at(0.5 * *scan.tilt.duration()) == Approx(0.0).margin(1e-12));
  CHECK(*curve.at(*scan.tilt.duration() + 1.0) == Approx(-0.6));
  SweepSettings settings;
  settings.tilt = scan.tilt;
  CHECK(worst(swept(gathered(scan), settings), scan.room) < kMillimetre);
  // Too short a way for the speed.
  const TiltCurve brief({.source = TiltSource::trapezoid,
                         .start = 0.0,
                         .end = 0.1,
                         .speed = 5.0,
                         .acceleration = 0.4},
                        0.0);
  CHECK(*brief.at(0.5) == Approx(0.05));
  CHECK(*brief.at(1.0) == Approx(0.1));
}

TEST_CASE("an encoder in the telegrams gives the tilt, whichever way it counts") {
  for (const double counts : {360000.0, -360000.0}) {
    RoomScan scan;
    scan.counts = counts;
    SweepSettings settings;
    settings.tilt = {.source = TiltSource::encoder, .counts = counts};
    CHECK(worst(swept(gathered(scan), settings), scan.room) < kMillimetre);
  }
}

TEST_CASE("angles from a file and from a feed give the tilt between them") {
  const RoomScan scan;
  const auto path = std::filesystem::temp_directory_path() / "velum_tilt_test.txt";
  {
    std::ofstream file(path);
    file << "# time [s], angle [deg]\n";
    for (int i = -1; i <= 42; ++i)
      file << 0.1 * i << "  " << (-0.5 + 0.25 * 0.1 * i) / lms::kDegree << "\n";
  }
  SweepSettings settings;
  settings.tilt = {.source = TiltSource::file, .file = path};
  const velum::Cloud cloud = swept(gathered(scan), settings);
  CHECK(worst(cloud, scan.room) < kMillimetre);
  std::ofstream(path) << "0 1\n1 2 3\n";
  try {
    static_cast<void>(read_tilt_file(path));
    FAIL("read a line of three numbers");
  } catch (const velum::Error& error) {
    CHECK(error.where() == path.string() + ":2");
  }
  std::filesystem::remove(path);

  // The feed's clock is that of arrivals: the first line began 40.5 ms before it was sent.
  LineGatherer lines;
  for (int i = -2; i <= 45; ++i) {
    const double angle = -0.5 + 0.25 * 0.1 * i;
    lines.add({Event::tilt,
               100'000 + std::int64_t{i} * 100'000'000,
               {reinterpret_cast<const char*>(&angle), sizeof(angle)}});  // NOLINT
  }
  scan.play([&](const Record& record) { lines.add(record); });
  settings.tilt = {.source = TiltSource::feed};
  CHECK(worst(swept(lines, settings), scan.room) < kMillimetre);
}

TEST_CASE("times without a tilt cost their returns, counted") {
  const RoomScan scan;
  LineGatherer lines = gathered(scan);
  const double angle = 0.1;
  lines.add({Event::tilt, 0, {reinterpret_cast<const char*>(&angle), sizeof(angle)}});  // NOLINT
  SweepSettings settings;
  settings.tilt = {.source = TiltSource::feed};
  lms::QuietContext context;
  SweepCounts counts;
  CHECK(make_sweep(lines, settings, counts, context).empty());
  CHECK(counts.untilted == 101 * 191);
}

TEST_CASE("the sweep begins at the trigger, and the skew is known") {
  const RoomScan scan;
  LineGatherer lines = gathered(scan);
  lines.add({Event::trigger, 1'000'000'000, "test"});
  SweepSettings settings;
  settings.tilt = scan.tilt;
  lms::QuietContext context;
  SweepCounts counts;
  const velum::Cloud cloud = make_sweep(lines, settings, counts, context);
  CHECK(cloud.size() == 76 * 191);
  CHECK(counts.skew == Approx(0.0001).margin(1e-9));
}

TEST_CASE("lost, repeated and foreign scans are counted, and connections are not mixed") {
  const RoomScan scan;
  LineGatherer lines;
  const auto add = [&](Scan one) {
    const std::string payload = encode_scan(one, Dialect::ascii);
    return lines.add({Event::ascii_telegram, 0, payload});
  };
  Scan laser_off = scan.line(0);
  laser_off.status = {1, 0};
  CHECK_FALSE(add(laser_off));
  CHECK(add(scan.line(1)));
  CHECK_FALSE(add(scan.line(1)));
  CHECK(add(scan.line(5)));
  Scan foreign = scan.line(6);
  foreign.serial = 12;
  CHECK_FALSE(add(foreign));
  CHECK(add(scan.line(7)));
  CHECK_FALSE(lines.add({Event::ascii_telegram, 0, "sSN LMDscandata 0 1 2"}));
  CHECK(lines.counts().lost == 4);
  CHECK(lines.counts().repeated == 1);
  CHECK(lines.counts().unusable == 1);
  CHECK(lines.counts().malformed == 2);
  CHECK(lines.lines().back().number == 7);
  // After a power cycle the clock and the counters begin anew.
  lines.add({Event::gap, 2'000'000'000, "no data"});
  lines.add({Event::connected, 3'000'000'000, "again"});
  Scan fresh = scan.line(0);
  fresh.start_time = 17;
  CHECK(add(fresh));
  CHECK(lines.counts().lost == 4);
  CHECK(lines.lines().back().number == 8);
  CHECK(lines.lines().back().clock == 1);
  CHECK(lines.lines().back().start == 17);
  CHECK(lines.gaps() == std::vector<std::string>{"no data at 2.000 s, connected again at 3.000 s"});
}

TEST_CASE("a counter or a clock that changed on the way costs its scan, a restart costs one") {
  const RoomScan scan;
  LineGatherer lines;
  const auto add = [&](const Scan& one) {
    const std::string payload = encode_scan(one, Dialect::ascii);
    return lines.add({Event::ascii_telegram, 0, payload});
  };
  CHECK(add(scan.line(1)));
  Scan damaged = scan.line(2);
  damaged.scan_counter ^= 0x40U;
  CHECK_FALSE(add(damaged));
  CHECK(add(scan.line(3)));
  damaged = scan.line(4);
  damaged.start_time ^= 0x100000U;
  CHECK_FALSE(add(damaged));
  CHECK(add(scan.line(5)));
  CHECK(add(scan.line(90)));
  CHECK(lines.counts().malformed == 2);
  CHECK(lines.counts().lost == 2 + 84);
  Scan restarted = scan.line(0);
  for (std::uint16_t i = 0; i < 5; ++i) {
    restarted.scan_counter = i;
    restarted.start_time = 5000 + 40000U * i;
    restarted.send_time = restarted.start_time + 40500;
    CHECK(add(restarted) == (i > 0));
  }
  CHECK(lines.counts().malformed == 3);
  CHECK(lines.counts().lost == 86);
}

TEST_CASE("several echoes become points of their own, or the one that is asked for") {
  RoomScan scan;
  scan.lines = 1;
  LineGatherer lines;
  Scan one = scan.line(0);
  Channel second = one.channels16.front();
  second.name = "DIST2";
  for (std::size_t i = 0; i < second.values.size(); ++i)
    second.values[i] = i % 2 == 0 ? 0 : static_cast<std::uint16_t>(second.values[i] + 100);
  one.channels16.push_back(second);
  const std::string payload = encode_scan(one, Dialect::binary);
  lines.add({Event::binary_telegram, 0, payload});
  SweepSettings settings;
  const velum::Cloud all = swept(lines, settings);
  CHECK(all.size() == 191 + 95);
  CHECK(all.column("echo").vector<int>()[2] == 2);
  settings.echoes = Echoes::first;
  CHECK(swept(lines, settings).column("echo").vector<int>().maxCoeff() == 1);
  settings.echoes = Echoes::last;
  const velum::Cloud last = swept(lines, settings);
  CHECK(last.size() == 191);
  CHECK(last.column("echo").vector<int>()[1] == 2);
  CHECK(last.column("echo").vector<int>()[2] == 1);
}

TEST_CASE("a law that lacks a parameter is a mistake in the graph") {
  const auto refused = [](const TiltSettings& settings) {
    try {
      settings.check();
    } catch (const velum::Error& error) {
      CHECK(error.fault() == velum::Fault::graph);
      return error.where();
    }
    return std::string();
  };
  CHECK(refused({.source = TiltSource::constant}) == "tilt_speed");
  CHECK(refused({.source = TiltSource::trapezoid, .speed = 1.0}) == "tilt_end");
  CHECK(refused({.source = TiltSource::trapezoid, .end = 1.0, .speed = 1.0}) ==
        "tilt_acceleration");
  CHECK(refused({.source = TiltSource::encoder}) == "encoder_counts");
  CHECK(refused({.source = TiltSource::file}) == "tilt_file");
  CHECK(refused({.source = TiltSource::constant, .end = 0.0, .speed = 1.0}) == "tilt_end");
  CHECK(refused({.source = TiltSource::feed}).empty());
}
