// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "scene/ranges.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "velum/error.hpp"

using namespace velum;
using namespace velum::scene;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kRepeats = 4000;

Scene scene_of(const std::string& text) {
  return parse_scene("format = 1\nunits = \"m\"\n" + text, "test.toml");
}
// A board of 4 m at `distance` ahead, turned about z.
std::string board(double distance, const std::string& more = "", double turned = 0.0) {
  return "[object.board" + std::to_string(static_cast<int>(1000 * distance)) +
         "]\nshape = \"box\"\nlabel = " + std::to_string(static_cast<int>(distance)) +
         "\nposition = [0, " + std::to_string(distance) +
         ", 0]\nsize = [4, 0.000001, 4]\nrotation = [0, 0, " + std::to_string(turned) + "]\n" +
         more + "\n";
}
std::string scanner(const std::string& errors, const std::string& more = "") {
  return "[scanner.a]\nerrors = \"" + errors + "\"\n" + more + "\n";
}

struct Statistics {
  double mean = 0.0;
  double deviation = 0.0;
  double returned = 0.0;
};
Statistics straight_ahead(const Scene& scene, double angle = 90.0 * kDegree, double time = 0.0) {
  const RangeFinder finder(scene, scene.scanners.front());
  double sum = 0.0;
  double squares = 0.0;
  int count = 0;
  const Random random(3);
  for (int i = 0; i < kRepeats; ++i) {
    const auto echo = finder.measure({angle, 0.0, time}, random.split(static_cast<unsigned>(i)));
    if (!echo) continue;
    ++count;
    sum += echo->range;
    squares += echo->range * echo->range;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(squares / count - mean * mean), static_cast<double>(count) / kRepeats};
}
double spread_at(double distance, double turned) {
  return straight_ahead(scene_of(board(distance, "", turned) + scanner("incidence"))).deviation;
}

}  // namespace

TEST_CASE("without effects a range has the scanner's noise and no error") {
  const auto found =
      straight_ahead(scene_of(board(2, "material = \"dark_gray\"") + scanner("none")));
  CHECK(found.mean == Approx(2.0).margin(2e-4));
  CHECK(found.deviation == Approx(0.004).epsilon(0.05));
  CHECK(found.returned == 1.0);
}

TEST_CASE("materials and colours have the spreads of 2.4.3.3 and the figures of table 2.2") {
  const auto found = [](const std::string& name) {
    return straight_ahead(
        scene_of(board(2, "material = \"" + name + "\"") + scanner("material, distance")));
  };
  CHECK(found("reflective").deviation == Approx(0.0033).epsilon(0.04));
  CHECK(found("sail").deviation == Approx(0.0041).epsilon(0.04));
  CHECK(found("green").mean == Approx(1.9978).margin(3e-4));
  CHECK(found("yellow").mean == Approx(2.0053).margin(3e-4));
  CHECK(found("light_gray").mean == Approx(1.9977).margin(3e-4));
  CHECK(found("dark_gray").mean == Approx(2.0147).margin(3e-4));
  CHECK(found("dark_gray").deviation == Approx(0.0040).epsilon(0.04));
}

TEST_CASE("the systematic error grows with the distance and stays below 0.27 %") {
  double before = 0.0;
  for (const double range : {0.5, 1.0, 2.0, 6.0, 12.0}) {
    const double error = distance_error(range);
    CHECK(error > before);
    CHECK(error <= 0.0027 * range + 1e-12);
    before = error;
  }
  CHECK(distance_error(2.0) / 2.0 == Approx(0.0027));
  CHECK(distance_error(12.0) / 12.0 < 0.002);
  CHECK(distance_error(6.0) < 0.012);
}

TEST_CASE("beams to the right measure too far, ahead and to the left too near") {
  CHECK(angulation_error(0.0) > 0.002);
  CHECK(angulation_error(60.0 * kDegree) > 0.0);
  CHECK(angulation_error(90.0 * kDegree) < 0.0);
  CHECK(angulation_error(180.0 * kDegree) < -0.002);
}

TEST_CASE("the spread grows beyond 70 degrees, the more the farther, and points are lost") {
  CHECK(spread_at(1, 60) == Approx(0.004).epsilon(0.05));
  CHECK(spread_at(3, 69) == Approx(0.004).epsilon(0.05));
  CHECK(spread_at(1, 80) > 1.2 * 0.004);
  CHECK(spread_at(3, 80) > spread_at(1, 80));
  const auto steep = straight_ahead(scene_of(board(1, "", 80) + scanner("incidence")));
  CHECK(steep.returned == Approx(0.75).margin(0.03));
  CHECK(straight_ahead(scene_of(board(1, "", 65) + scanner("incidence"))).returned == 1.0);
}

TEST_CASE("the sun spoils the beams that look into it") {
  const std::string sun = "[sun]\ndirection = [0, 1, 0]\n";
  const std::string low = "position = [0, -3, 2.1]\n";  // looks over the board's edge into the sun
  const auto lit = [&](const std::string& objects, const std::string& place) {
    const Scene scene = scene_of(sun + objects + scanner("light", place));
    return RangeFinder(scene, scene.scanners.front()).sunlight();
  };
  CHECK(lit(board(2), low) == Sunlight::direct);
  CHECK(lit(board(2), "") == Sunlight::none);
  CHECK(lit(board(2, "material = \"sail\""), "") == Sunlight::through_cloth);
  CHECK(lit(board(2, "material = \"sail\"") + board(3), "") == Sunlight::none);
  const Scene cloth = scene_of(sun + board(2, "material = \"sail\"") + scanner("light"));
  CHECK(straight_ahead(cloth).deviation == Approx(1.5 * 0.004).epsilon(0.05));
  CHECK(straight_ahead(cloth, 60.0 * kDegree).deviation == Approx(0.004).epsilon(0.05));
  CHECK(glare(Sunlight::direct, 0.0, 0.1) == Approx(4.5));
}

TEST_CASE("some pulses pass through cloth and come back from what is behind") {
  const std::string thin = "[material.veil]\nlike = \"sail\"\ntransmission = 0.25\nremission = 1\n";
  const Scene scene = scene_of(thin + board(2, "material = \"veil\"") + board(5) +
                               scanner("transparency", "noise = 0"));
  // A quarter at 5 m, the rest at 2 m.
  CHECK(straight_ahead(scene).mean == Approx(2.0 + 0.25 * 3.0).margin(0.06));
  const Scene sky =
      scene_of(thin + board(2, "material = \"veil\"") + scanner("transparency", "noise = 0"));
  CHECK(straight_ahead(sky).returned == Approx(0.75).margin(0.03));
}

TEST_CASE("dark surfaces are lost sooner than white ones") {
  const auto returned = [](double distance, const std::string& remission, double turned = 0.0) {
    return straight_ahead(scene_of("[material.m]\nremission = " + remission + "\n" +
                                   board(distance, "material = \"m\"", turned) +
                                   scanner("remission")))
        .returned;
  };
  CHECK(returned(79, "1.0") == 1.0);
  CHECK(std::isnan(straight_ahead(scene_of(board(81) + scanner("remission"))).mean));
  CHECK(returned(25, "0.1") == 1.0);
  CHECK(returned(26, "0.1") == 0.0);
  CHECK(returned(20, "0.1", 60) == 0.0);  // half the light
}

TEST_CASE("the first hour's excess is that of table 2.1") {
  const auto hour = [](int number) {
    double sum = 0.0;
    for (int i = 0; i < 1000; ++i) sum += warm_up_error(number - 1 + (i + 0.5) / 1000.0);
    return sum / 1000.0;
  };
  CHECK(hour(1) == Approx(0.0007).margin(5e-5));
  CHECK(hour(2) == Approx(0.0001).margin(3e-5));
  CHECK(hour(9) < 1e-6);
}

TEST_CASE("effects are named, and a wrong name is answered with the right ones") {
  CHECK(Effects::named("none") == Effects());
  CHECK(Effects::named("all").has(Effect::warm_up));
  const Effects some = Effects::named("light , mixed_pixels");
  CHECK((some.has(Effect::light) && some.has(Effect::mixed_pixels)));
  CHECK_FALSE(some.has(Effect::distance));
  CHECK_THROWS_AS(Effects::named("lights"), Error);
  CHECK_THROWS_AS(Effects::named("light,"), Error);
}

TEST_CASE("mistakes in materials, sun and errors have a place") {
  const auto place = [](const std::string& text) -> std::string {
    try {
      static_cast<void>(scene_of(text));
    } catch (const Error& error) {
      return error.where();
    }
    return "";
  };
  CHECK(place("[material.m]\nlike = \"wool\"\n") == "test.toml:4:8");
  CHECK(place("[material.m]\ntransmission = 1.0\n") == "test.toml:4:16");
  CHECK(place("[sun]\nwidth = 5\n") == "test.toml:3:1");
  CHECK(place("[scanner.a]\nerrors = \"rain\"\n") == "test.toml:4:10");
  CHECK(place("[scanner.a]\nrepeats = 0\n") == "test.toml:4:11");
  CHECK(place("[object.o]\nlabel = 1\nshape = \"box\"\nsize = [1, 1, 1]\nmaterial = \"wool\"\n") ==
        "test.toml:7:12");
}
