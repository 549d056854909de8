// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "formats/test_stages.hpp"

using velum::Cloud;
using velum::Error;
using velum::Fault;
using velum::formats::test::fault_of;
using velum::formats::test::Folder;
using velum::formats::test::full_cloud;
using velum::formats::test::put;
using velum::test::Stage;

namespace {

Stage stage(const std::filesystem::path& file) {
  return velum::formats::test::stage_on("io.read_cloud", file);
}

}  // namespace

TEST_CASE("a text file gives its points, in metres") {
  const Folder folder;
  const auto outcome = stage(put(folder, "a.txt", "1 2 3\n4 5 6\n")).run();
  CHECK(outcome.cloud().size() == 2);
  CHECK(outcome.measure("points") == 2.0);
  CHECK(outcome.measure("dropped") == 0.0);
}

TEST_CASE("units scale the file's lengths") {
  const Folder folder;
  const auto outcome = stage(put(folder, "a.txt", "1000 2000 3000\n")).set("units", "mm").run();
  CHECK(outcome.cloud().positions().col(0) == Eigen::Vector3f(1, 2, 3));
}

TEST_CASE("columns are named by the parameter") {
  const Folder folder;
  const auto outcome = stage(put(folder, "a.txt", "9 1 2 3\n"))
                           .set("columns", "[\"intensity\", \"x\", \"y\", \"z\"]")
                           .run();
  CHECK(outcome.cloud().intensity()[0] == 9.0F);
}

TEST_CASE("a left-handed scan is turned") {
  const Folder folder;
  const auto outcome = stage(put(folder, "a.3d", "100 200 300\n"))
                           .set("units", "cm")
                           .set("handedness", "left")
                           .run();
  CHECK(outcome.cloud().positions().col(0) == Eigen::Vector3f(3, -1, 2));
}

TEST_CASE("points that are not finite are dropped, counted and told") {
  const Folder folder;
  const auto outcome = stage(put(folder, "a.txt", "1 2 3\nnan 5 6\n")).run();
  CHECK(outcome.cloud().size() == 1);
  CHECK(outcome.measure("dropped") == 1.0);
  CHECK(outcome.warnings.size() == 1);
}

TEST_CASE("columns of a file that names its own are a mistake in the graph") {
  const Folder folder;
  velum::formats::test::write(folder / "a.pcd", full_cloud(3));
  CHECK(fault_of(stage(folder / "a.pcd").set("columns", "[\"x\", \"y\", \"z\"]")) == Fault::graph);
}

TEST_CASE("bad content is a fault of the input") {
  const Folder folder;
  CHECK(fault_of(stage(put(folder, "a.txt", "1 2 3\n4 5\n"))) == Fault::input);
  CHECK(fault_of(stage(put(folder, "empty.pcd", ""))) == Fault::input);
  CHECK(fault_of(stage(put(folder, "b.pcd", "1 2 3\n"))) == Fault::input);
}

TEST_CASE("a folder and a missing file are refused") {
  const Folder folder;
  CHECK_THROWS_AS(stage(folder / "missing.pcd").run(), Error);
  CHECK_THROWS_AS(stage(folder / "").run(), Error);
  CHECK_THROWS_AS(Stage("io.read_cloud").run(), Error);
}

TEST_CASE("conformance") {
  const Folder folder;
  velum::formats::test::write(folder / "a.ply", full_cloud(2000));
  for (const auto& fault :
       velum::test::conformance("io.read_cloud", {{"file", (folder / "a.ply").string()}}))
    FAIL_CHECK(fault);
}
