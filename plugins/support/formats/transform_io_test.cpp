// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/transform_io.hpp"

#include <catch2/catch.hpp>

#include "formats/test_tools.hpp"

using namespace velum;
using namespace velum::formats;
using Catch::Matchers::Contains;

namespace {

Transform read(std::string_view text, const TransformOptions& options = {}) {
  return read_transform(Source("motion.txt", text), options);
}

std::string error(std::string_view text, const TransformOptions& options = {}) {
  try {
    (void)read(text, options);
  } catch (const Error& error) {
    return error.where() + ": " + error.what();
  }
  return "";
}

Transform some_motion() {
  Transform transform;
  transform.matrix.linear() =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
  transform.matrix.translation() = Eigen::Vector3d(0.1, 1.0 / 3.0, -4e6);
  transform.source = "scan \"b\"";
  transform.target = "room";
  transform.fitness = 7.1e-8;
  return transform;
}

}  // namespace

TEST_CASE("a motion is read back bit by bit, with its frames, from text and JSON") {
  const test::Folder folder;
  const Transform motion = some_motion();
  for (const char* name : {"motion.txt", "motion.json"}) {
    INFO(name);
    write_transform(folder / name, motion, TransformFormat::automatic, {});
    const Transform back = read_transform(Source(folder / name), {});
    CHECK(back.matrix.matrix() == motion.matrix.matrix());
    CHECK(back.source == motion.source);
    CHECK(back.target == motion.target);
    CHECK(back.fitness == motion.fitness);
  }
}

TEST_CASE("the unit that a file names counts before the parameter") {
  const test::Folder folder;
  const Transform motion = some_motion();
  for (const char* name : {"motion.txt", "motion.json"}) {
    write_transform(folder / name, motion, TransformFormat::automatic, length_unit("mm"));
    const Transform back = read_transform(Source(folder / name), {25.4, ""});
    CHECK(back.matrix.translation().isApprox(motion.matrix.translation(), 1e-15));
  }
  CHECK(read("1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1", {0.01, ""}).matrix.translation().x() == 0.05);
}

TEST_CASE("plain numbers, with brackets and commas too") {
  CHECK(read("[[1, 0, 0, 5], [0, 1, 0, 0],\n [0, 0, 1, 0], [0, 0, 0, 1]]").matrix(0, 3) == 5.0);
  CHECK(read("1,0,0,5\n0,1,0,0\n0,0,1,0\n0,0,0,1\n").matrix(0, 3) == 5.0);
}

TEST_CASE("a matrix within a JSON file is found by its place") {
  const std::string text =
      R"({"world": {"b": [[1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]]}, "flat": {"matrix":
          [1,0,0,4,0,1,0,0,0,0,1,0,0,0,0,1]}})";
  CHECK(read(text, {1.0, "/world/b"}).matrix(1, 3) == 2.0);
  CHECK(read(text, {1.0, "/flat"}).matrix(0, 3) == 4.0);
  CHECK_THAT(error(text, {1.0, "/world/c"}), Contains("no entry '/world/c'"));
  CHECK_THAT(error(text), Contains("no entry 'matrix'"));
}

TEST_CASE("a rounded rotation becomes the closest exact one") {
  const Transform rounded = read("0.8660 -0.5 0 0\n0.5 0.8660 0 0\n0 0 1 0\n0 0 0 1\n");
  const Eigen::Matrix3d turn = rounded.matrix.linear();
  CHECK((turn.transpose() * turn).isIdentity(1e-14));
  CHECK(turn(0, 0) == Approx(std::sqrt(3.0) / 2.0).margin(1e-4));
}

TEST_CASE("what is no rigid motion is refused with its deviation") {
  CHECK_THAT(error("2 0 0 0\n0 2 0 0\n0 0 2 0\n0 0 0 1\n"), Contains("deviate by 3 "));
  CHECK_THAT(error("1 0 0 0\n0 1 0 0\n0 0 -1 0\n0 0 0 1\n"), Contains("determinant is -1"));
  CHECK_THAT(error("1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 1 1\n"), Contains("last row by 1"));
  CHECK_THAT(error("nan 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"), Contains("not finite"));
}

TEST_CASE("files that hold no matrix are refused") {
  CHECK_THAT(error("1 2 3\n"), Contains("found 3 numbers"));
  CHECK_THAT(error("1 0 0 0 0 1 0 0\n0 0 1 0 0 0 0 1 5\n"), Contains("motion.txt:2"));
  CHECK_THAT(error("# a\none two\n"), Contains("motion.txt:2: found 'one'"));
  CHECK_THAT(error("{\"matrix\": [1, 2"), Contains("no JSON"));
  CHECK_THAT(error("{\"matrix\": \"none\"}"), Contains("found 0 numbers"));
  CHECK_THAT(error("# unit: parsec\n1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n"), Contains("motion.txt"));
  CHECK_THAT(error("{" + std::string(20000, '[')), Contains("no JSON"));
}
