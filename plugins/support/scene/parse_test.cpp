// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <numbers>

#include "scene/scan.hpp"
#include "scene/scene.hpp"
#include "velum/error.hpp"

using namespace velum;
using namespace velum::scene;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
const std::string kHead = "format = 1\nunits = \"m\"\n";

struct Refusal {
  std::string where;
  std::string message;
  std::string hint;
};

Refusal refusal(const std::string& text) {
  try {
    static_cast<void>(parse_scene(text, "some.toml"));
  } catch (const Error& error) {
    CHECK(error.fault() == Fault::input);
    return {error.where(), error.what(), error.hint()};
  }
  return {};
}

}  // namespace

TEST_CASE("lengths follow the file's unit, angles are degrees, and both may say their own") {
  const Scene scene = parse_scene(
      "format = 1\nunits = \"mm\"\n[scanner.a]\nposition = [1000, 0, \"0.5 m\"]\nbeam_step = 0.5\n"
      "tilt_from = \"-0.1 rad\"\nnoise = 3\n[object.b]\nshape = \"ellipsoid\"\nlabel = 4\n"
      "position = [0, 0, 0]\nsemi_axes = [100, 200, 300]\n",
      "x.toml");
  const Scanner& scanner = scene.scanner("a");
  CHECK(scanner.pose.translation().isApprox(Eigen::Vector3d(1.0, 0.0, 0.5)));
  CHECK(scanner.beam_step == Approx(0.5 * kDegree));
  CHECK(scanner.tilt_from == Approx(-0.1));
  CHECK(scanner.noise == Approx(0.003));
  CHECK(scanner.beam_from == Approx(-5.0 * kDegree));
  CHECK(std::get<Ellipsoid>(scene.object("b").shapes.front()).semi_axes.y() == Approx(0.2));
}

TEST_CASE("frames carry what stands in them") {
  const Scene scene =
      parse_scene(kHead +
                      "[frame.boat]\nposition = [10, 0, 0]\nrotation = [0, 0, 90]\n[frame.deck]\n"
                      "frame = \"boat\"\nposition = [0, 0, 1]\n[scanner.a]\nframe = \"deck\"\n"
                      "position = [2, 0, 0]\n",
                  "x.toml");
  CHECK(scene.scanner("a").pose.translation().isApprox(Eigen::Vector3d(10, 2, 1)));
}

TEST_CASE("mistakes are told with file, line and column") {
  CHECK(refusal("format = 1\nunits = \"m\"\n[scanner.a]\nbeam_stp = 1\n").where == "some.toml:4:1");
  CHECK(refusal(kHead + "[scanner.a]\nbeam_stp = 1\n").hint == "did you mean 'beam_step'?");
  CHECK(refusal(kHead + "[object.a]\nlabel = 1\nshape = \"torus\"\n").where == "some.toml:5:9");
  CHECK(refusal(kHead + "[object.a]\nlabel = 1\n").message ==
        "object 'a' has no 'shape', which it needs");
  CHECK(refusal(kHead + "[object.a\n").where.substr(0, 12) == "some.toml:3:");
  CHECK(refusal(kHead + "[scanner.a]\nnoise = \"3 kg\"\n").where == "some.toml:4:9");
  CHECK(refusal(kHead + "[scanner.a]\nposition = [1, 2]\n").message ==
        "'position' of scanner 'a' must be an array of 3 values");
  CHECK(refusal(kHead + "[scanner.a]\nframe = \"deck\"\n").where == "some.toml:4:9");
  CHECK(refusal("units = \"m\"\n").message == "the scene has no 'format', which it needs");
  CHECK(refusal("format = 1\nunits = \"furlong\"\n").where == "some.toml:2:9");
  CHECK(refusal(kHead + "[object.a]\nlabel = 1.5\nshape = \"box\"\n").where == "some.toml:4:9");
}

TEST_CASE("a cone has an apex, a base and a radius") {
  const std::string cone = kHead + "[object.c]\nlabel = 1\nshape = \"cone\"\napex = [0, 0, 2]\n";
  const Scene scene = parse_scene(cone + "base = [0, 0, 0]\nradius = 0.5\n", "x.toml");
  CHECK(std::get<Cone>(scene.object("c").shapes.front()).radius == 0.5);
  CHECK(refusal(cone + "base = [0, 0, 2]\nradius = 0.5\n").where == "some.toml:7:8");
  CHECK(refusal(cone + "base = [0, 0, 0]\nradius = 0\n").where == "some.toml:8:10");
}

TEST_CASE("values that make no sense are refused") {
  CHECK(refusal(kHead + "[scanner.a]\nbeam_step = 0\n").where == "some.toml:4:13");
  CHECK(refusal(kHead + "[scanner.a]\nbeam_from = 10\nbeam_to = 5\n").where == "some.toml:5:11");
  CHECK(refusal(kHead + "[scanner.a]\nnoise = -1\n").where == "some.toml:4:9");
  CHECK(refusal(kHead + "[scanner.a]\nrange_min = 5\nrange_max = 4\n").where == "some.toml:5:13");
  CHECK(refusal(kHead + "[scanner.a]\nposition = [inf, 0, 0]\n").where == "some.toml:4:13");
  const std::string sail =
      kHead +
      "[object.s]\nlabel = 1\nshape = \"sail\"\ntack = [0,0,0]\nhead = [0,0,2]\n"
      "leeward = \"port\"\nsections = [{height = 0, chord = 1, camber = 10, draft = 20}]\n";
  CHECK(refusal(sail).message == "'draft' of a section must be between 34 and 66");
  CHECK(refusal(kHead + "[object.m]\nlabel = 1\nshape = \"mesh\"\nvertices = [[0,0,0],[1,0,0],"
                        "[0,1,0]]\ntriangles = [[0,1,3]]\n")
            .message == "a triangle's corner must be a vertex number from 0 to 2");
}

TEST_CASE("asking for what is not there names what is") {
  const Scene scene = parse_scene(kHead + "[scanner.bow]\n[scanner.stern]\n", "x.toml");
  try {
    static_cast<void>(scene.scanner("mast"));
    FAIL("found a scanner that does not exist");
  } catch (const Error& error) {
    CHECK(error.fault() == Fault::graph);
    CHECK(error.hint() == "known: bow, stern");
  }
}

TEST_CASE("the scenes that ship are read, and their sails are named") {
  const std::string folder = std::string(VELUM_SOURCE_DIR) + "/graphs/scenes/";
  const Scene tunnel = read_scene(folder + "wind_tunnel.toml");
  CHECK(tunnel.scanners.size() == 2);
  CHECK(tunnel.object("gennaker").sail() != nullptr);
  CHECK(tunnel.object("mainsail").sail() != nullptr);
  const Scene boat = read_scene(folder + "on_field.toml");
  CHECK(boat.scanners.size() == 2);
  CHECK(boat.object("jib").sail() != nullptr);
}
