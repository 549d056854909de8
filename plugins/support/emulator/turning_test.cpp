// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <numbers>

#include "emulator/revolutions.hpp"
#include "lms511/test_tools.hpp"

using namespace velum;
using namespace velum::emulator;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr lms511::Mode kPlain{2500, 1667, 1};
constexpr lms511::Mode kFourfold{10000, 1667, 4};

Turn whole_turn(const lms511::Mode& mode, std::uint64_t number) {
  return Mirror(mode).turn(number, lms511::kViewFrom, lms511::kViewTo);
}

scene::Scene wall() {
  return scene::parse_scene(
      "format = 1\nunits = \"m\"\n[object.wall]\nshape = \"plane\"\nlabel = 1\n"
      "position = [0, 2, 0]\nnormal = [0, -1, 0]\n"
      "[scanner.a]\nnoise = 0\ntilt_from = -10\ntilt_to = 10\ntilt_step = 0.25\n",
      "wall.toml");
}

}  // namespace

TEST_CASE("the pairs of frequency and resolution have the points of the manual") {
  const auto beams = [](std::uint32_t frequency, std::uint32_t resolution) {
    return whole_turn(lms511::mode_of(frequency, resolution).value(), 0).beams;
  };
  CHECK(beams(2500, 1667) == 1141);
  CHECK(beams(2500, 2500) == 761);
  CHECK(beams(3500, 5000) == 381);
  CHECK(beams(5000, 3333) == 571);
  CHECK(beams(7500, 10000) == 191);
  CHECK(beams(10000, 6667) == 286);
  CHECK(Mirror(kPlain).shots() == 540);
  CHECK(Mirror(lms511::mode_of(5000, 5000).value()).shots() == 360);
  CHECK(Mirror(kFourfold).shots() == 540);
}

TEST_CASE("interlaced revolutions begin as real ones do") {
  const std::array<std::int32_t, 5> starts{-50000, -46666, -48333, -44999, -50000};
  const std::array<int, 5> beams{286, 285, 285, 285, 286};
  for (std::uint64_t i = 0; i < starts.size(); ++i) {
    const Turn turn = whole_turn(kFourfold, i);
    CHECK(turn.start == starts[i]);
    CHECK(turn.beams == beams[i]);
    CHECK(turn.step == 6667);
    CHECK(turn.first == Approx(lms511::true_start(turn.start)).margin(1e-9));
    CHECK(turn.spacing == Approx(lms511::true_step(turn.step)).margin(1e-12));
  }
  const lms511::Mode twofold = lms511::mode_of(5000, 1667).value();
  CHECK(whole_turn(twofold, 0).start == -50000);
  CHECK(whole_turn(twofold, 1).start == -48333);
  CHECK(whole_turn(twofold, 1).beams == 570);
}

TEST_CASE("an output range cuts the grid and does not move it") {
  const Turn turn = Mirror(lms511::Mode{10000, 6667, 1}).turn(0, 300000, 1500000);
  CHECK(turn.start == 303333);
  CHECK(turn.first == Approx((30.0 + 1.0 / 3.0) * kDegree));
  CHECK(turn.beams == 180);
  CHECK(Mirror(kPlain).turn(0, 900000, 900000).beams == 1);
  CHECK(Mirror(kPlain).turn(0, 900100, 900200).beams == 0);
}

TEST_CASE("a mirror needs its time from beam to beam") {
  const Mirror mirror(kPlain);
  CHECK(mirror.period() == 40000.0);
  CHECK(mirror.delay(-5.0 * kDegree) == Approx(0.0).margin(1e-6));
  CHECK(mirror.delay(185.0 * kDegree) == Approx(40000.0 * 190.0 / 360.0));
}

TEST_CASE("the plate rests, runs and arrives") {
  Plate plate({-0.2, 0.3, 0.1}, {3600.0, 1000.0});
  CHECK(plate.tilt(5e6) == -0.2);
  plate.start(2e6);
  CHECK(plate.tilt(1e6) == -0.2);
  CHECK(plate.tilt(4e6) == Approx(0.0).margin(1e-12));
  CHECK_FALSE(plate.finished(6.9e6));
  CHECK(plate.finished(7.1e6));
  CHECK(plate.tilt(9e6) == Approx(0.3));
  CHECK(plate.counts(4e6) == 1000);
  CHECK(plate.counts(9e6) == 1000 + std::lround(3600.0 * 0.3 / (2.0 * std::numbers::pi)));
}

TEST_CASE("revolutions are scans of what stands before the scanner") {
  const View view(wall(), "a", Random(1));
  Device device{plain_profile(), kPlain};
  Revolutions revolutions(device, view, Plate({0, 0, 0.1}, {}));
  revolutions.mark_switched_on();
  const auto first = revolutions.next();
  const auto second = revolutions.next();
  REQUIRE((first && second));
  CHECK_FALSE(first->usable());  // the laser has just been switched on
  CHECK(second->usable());
  CHECK(second->scan_counter == first->scan_counter + 1);
  CHECK(second->telegram_counter == first->telegram_counter + 1);
  CHECK(second->start_time - first->start_time == 40000);
  CHECK(first->send_time - first->start_time == 40900);
  const lms511::Channel* ranges = second->channel("DIST1");
  REQUIRE(ranges != nullptr);
  REQUIRE(ranges->values.size() == 1141);
  CHECK(ranges->values[570] == 2000);        // 90 degrees
  CHECK(ranges->values[570 - 180] == 2309);  // 60 degrees
  CHECK(ranges->values[0] == 0);             // away from the wall
  CHECK(second->channel("RSSI1")->values[570] == 254);
  CHECK(second->channel("RSSI1")->values[0] == 0);
  CHECK(second->encoders.empty());
}

TEST_CASE("scans hold what LMDscandatacfg and FREchoFilter switch on") {
  const View view(wall(), "a", Random(1));
  Device device{plain_profile(), kPlain};
  Session session;
  session.level = 3;
  const auto tell = [&](const std::string& text) {
    CHECK(answer(device, {lms511::Dialect::ascii, text}, session).frame.substr(1, 3) == "sWA");
  };
  tell("sWN LMDscandatacfg 1F 00 0 0 0 01 00 0 1 0 1 +3");
  tell("sWN FREchoFilter 1");
  tell("sWN LMPoutputRange 1 683 +600000 +1200000");
  Revolutions revolutions(device, view, Plate({-0.1, 0.1, 0.1}, {360000.0, 200000.0}));
  revolutions.start_plate();
  std::vector<lms511::Scan> scans;
  for (int i = 0; i < 9; ++i)
    if (auto scan = revolutions.next()) scans.push_back(std::move(*scan));
  REQUIRE(scans.size() == 3);  // every third
  const lms511::Scan& scan = scans.back();
  CHECK(scan.channels16.size() == 5);
  CHECK(scan.channels8.empty());
  CHECK(scan.channels16.front().values.size() == 361);
  CHECK(scan.channels16.back().name == "DIST5");
  CHECK(scan.name == "SN 18000001");
  CHECK(scan.time.has_value());
  REQUIRE(scan.encoders.size() == 1);
  const double tilt = -0.1 + 0.1 * 8 * 0.04;
  CHECK(scan.encoders.front().position ==
        200000 + std::lround(360000.0 * tilt / (2.0 * std::numbers::pi)));
}

TEST_CASE("a poll gives the last whole revolution") {
  const View view(wall(), "a", Random(1));
  Device device{plain_profile(), kPlain};
  Revolutions revolutions(device, view, Plate({0, 0, 0.1}, {}));
  revolutions.pass_until(1e6);
  const lms511::Scan scan = revolutions.last();
  CHECK(scan.polled);
  CHECK(scan.start_time <= 1e6 - 40000.0);
  CHECK(scan.start_time > 1e6 - 3 * 40000.0);
  CHECK(revolutions.last().scan_counter == scan.scan_counter);
}
