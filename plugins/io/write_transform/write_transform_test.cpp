// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "formats/test_faults.hpp"
#include "formats/test_stages.hpp"

#include "formats/transform_io.hpp"

using velum::Error;
using velum::Transform;
using velum::formats::test::Folder;
using velum::formats::test::text_of;
using velum::test::Stage;

namespace {

Stage stage(const std::filesystem::path& file) {
  return velum::formats::test::stage_on("io.write_transform", file);
}

Transform motion() {
  Transform made;
  made.matrix.linear() =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(3, 1, 2).normalized()).toRotationMatrix();
  made.matrix.translation() = Eigen::Vector3d(1.0 / 3.0, 2, 3);
  made.source = "scan";
  made.target = "room";
  return made;
}

Transform read(const std::filesystem::path& path) {
  return velum::formats::read_transform(velum::formats::Source(path), {});
}

}  // namespace

TEST_CASE("a motion is read back bit by bit") {
  const Folder folder;
  for (const char* name : {"a.txt", "a.json"}) {
    INFO(name);
    stage(folder / name).run(motion());
    CHECK(read(folder / name).matrix.matrix() == motion().matrix.matrix());
  }
}

TEST_CASE("both frames are named") {
  const Folder folder;
  for (const char* name : {"a.txt", "a.json"}) {
    stage(folder / name).run(motion());
    CHECK(read(folder / name).source == "scan");
    CHECK(read(folder / name).target == "room");
  }
}

TEST_CASE("the format may be asked for") {
  const Folder folder;
  stage(folder / "a.dat").set("format", "json").run(motion());
  CHECK(text_of(folder / "a.dat").front() == '{');
  stage(folder / "a.dat").set("format", "text").run(motion());
  CHECK(text_of(folder / "a.dat").front() == '#');
}

TEST_CASE("the translation is in the unit asked for, which the file names") {
  const Folder folder;
  stage(folder / "a.txt").set("units", "mm").run(motion());
  CHECK_THAT(text_of(folder / "a.txt"),
             Catch::Contains("# unit: mm") && Catch::Contains(" 2000\n"));
  CHECK(read(folder / "a.txt").matrix.isApprox(motion().matrix, 1e-15));
}

TEST_CASE("an earlier file is replaced, a folder is not") {
  const Folder folder;
  velum::write_file(folder / "a.txt", "earlier");
  stage(folder / "a.txt").run(motion());
  CHECK(text_of(folder / "a.txt") != "earlier");
  std::filesystem::create_directory(folder / "b.txt");
  CHECK_THROWS_AS(stage(folder / "b.txt").run(motion()), Error);
}

TEST_CASE("a read-only folder and a kill leave no half file") {
  std::vector<std::string> faults;
  const auto write = [](const auto& path) { stage(path).threads(1).run(motion()); };
  velum::formats::test::read_only(write, faults);
  velum::formats::test::killed(write, faults);
  for (const std::string& fault : faults) FAIL_CHECK(fault);
}

TEST_CASE("an interrupted run leaves nothing") {
  const Folder folder;
  CHECK_THROWS(stage(folder / "a.txt").cancelled().run(motion()));
  CHECK_FALSE(std::filesystem::exists(folder / "a.txt"));
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("io.write_transform", {{"file", "a.txt"}}))
    FAIL_CHECK(fault);
}
