// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cstdlib>

#include "formats/test_stages.hpp"

using velum::Error;
using velum::Fault;
using velum::Transform;
using velum::formats::test::Folder;
using velum::formats::test::put;
using velum::test::Stage;

namespace {

const std::string kMotion = "1 0 0 5\n0 0 -1 6\n0 1 0 7\n0 0 0 1\n";

Stage stage(const std::filesystem::path& file) {
  return velum::formats::test::stage_on("io.read_transform", file);
}

Transform read(Stage made) {
  return made.run().get<Transform>();
}

}  // namespace

TEST_CASE("sixteen numbers are a motion") {
  const Folder folder;
  const Transform motion = read(stage(put(folder, "a.txt", kMotion)));
  CHECK((motion.matrix * Eigen::Vector3d(1, 2, 3)).isApprox(Eigen::Vector3d(6, 3, 9)));
  CHECK(motion.source == "source");
}

TEST_CASE("the unit of the translation") {
  const Folder folder;
  const auto file = put(folder, "a.txt", kMotion);
  CHECK(read(stage(file).set("units", "mm")).matrix.translation().x() == 0.005);
  const auto named = put(folder, "b.txt", "# unit: cm\n" + kMotion);
  CHECK(read(stage(named).set("units", "mm")).matrix.translation().x() == 0.05);
}

TEST_CASE("frames are those of the file, or of the parameters") {
  const Folder folder;
  const auto file = put(folder, "a.txt", "# source: scan b\n# target: room\n" + kMotion);
  CHECK(read(stage(file)).source == "scan b");
  CHECK(read(stage(file)).target == "room");
  CHECK(read(stage(file).set("source", "scan c")).source == "scan c");
}

TEST_CASE("an entry of a JSON file") {
  const Folder folder;
  const auto file =
      put(folder, "a.json", R"({"T": {"0,1": [[1,0,0,3],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}})");
  CHECK(read(stage(file).set("entry", "/T/0,1")).matrix.translation().x() == 3.0);
}

TEST_CASE("a matrix that is not rigid is refused") {
  const Folder folder;
  try {
    (void)stage(put(folder, "a.txt", "1 0 0 5\n0 0 -1 6\n0 1.1 0 7\n0 0 0 1\n")).run();
    FAIL("it was taken");
  } catch (const Error& error) {
    CHECK(error.fault() == Fault::input);
    CHECK_THAT(error.what(), Catch::Contains("0.21"));
  }
}

TEST_CASE("files without sixteen numbers are refused") {
  const Folder folder;
  CHECK_THROWS_AS(stage(put(folder, "a.txt", "1 2 3\n")).run(), Error);
  CHECK_THROWS_AS(stage(put(folder, "b.txt", "")).run(), Error);
  CHECK_THROWS_AS(stage(folder / "missing.txt").run(), Error);
}

TEST_CASE("the motions that come with real data") {
  const char* shared = std::getenv("VELUM_SHARED");
  const auto data = std::filesystem::path(shared == nullptr ? "" : shared) / "data/registration";
  if (!std::filesystem::exists(data)) {
    WARN("skipped: no shared data");
    return;
  }
  CHECK(read(stage(data / "small_gicp/T_target_source.txt")).matrix(0, 3) == 0.488882);
  CHECK(read(stage(data / "redkitchen/truth.json").set("entry", "/T/0,1")).matrix(0, 3) ==
        -0.115576939);
  CHECK(
      read(stage(data / "bunny/truth.json").set("entry", "/world_from_scan/bun045")).matrix(0, 3) ==
      -0.0520211);
}

TEST_CASE("conformance") {
  const Folder folder;
  for (const auto& fault : velum::test::conformance(
           "io.read_transform", {{"file", put(folder, "a.txt", kMotion).string()}}))
    FAIL_CHECK(fault);
}
