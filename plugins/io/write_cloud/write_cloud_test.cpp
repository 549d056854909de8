// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "formats/test_faults.hpp"
#include "formats/test_stages.hpp"

using velum::Cloud;
using velum::Error;
using velum::Fault;
using velum::formats::test::Folder;
using velum::formats::test::full_cloud;
using velum::formats::test::plain_cloud;
using velum::formats::test::read_file;
using velum::test::Stage;

namespace {

Stage stage(const std::filesystem::path& file) {
  return velum::formats::test::stage_on("io.write_cloud", file);
}

constexpr const char* kFormats[] = {"pcd", "pcd_ascii", "pcd_compressed", "ply", "ply_ascii", "xyz",
                                    "csv", "vtk",       "vtk_ascii"};

}  // namespace

TEST_CASE("every format is written and read back") {
  const Folder folder;
  const Cloud cloud = full_cloud(500);
  for (const char* format : kFormats) {
    INFO(format);
    const auto path = folder / (std::string(format) + ".dat");
    const auto outcome = stage(path).set("format", format).run(cloud);
    CHECK(outcome.measure("points") == 500.0);
    CHECK(read_file(path).positions() == cloud.positions());
    CHECK(read_file(path).normals() == cloud.normals());
  }
}

TEST_CASE("the extension chooses the format") {
  const Folder folder;
  for (const char* name : {"a.pcd", "a.ply", "a.xyz", "a.txt", "a.csv"}) {
    INFO(name);
    stage(folder / name).run(plain_cloud(10));
    CHECK(read_file(folder / name).size() == 10);
  }
  CHECK_THROWS_AS(stage(folder / "a.docx").run(plain_cloud(10)), Error);
}

TEST_CASE("coordinates are in the unit asked for") {
  const Folder folder;
  stage(folder / "a.xyz").set("units", "mm").run(plain_cloud(10));
  CHECK(read_file(folder / "a.xyz").positions().isApprox(plain_cloud(10).positions() * 1000.0F));
}

TEST_CASE("an earlier file of that name is replaced") {
  const Folder folder;
  stage(folder / "a.pcd").run(plain_cloud(10));
  stage(folder / "a.pcd").run(plain_cloud(20));
  CHECK(read_file(folder / "a.pcd").size() == 20);
}

TEST_CASE("a target that is a folder is refused") {
  const Folder folder;
  std::filesystem::create_directory(folder / "a.pcd");
  CHECK_THROWS_AS(stage(folder / "a.pcd").run(plain_cloud(10)), Error);
}

TEST_CASE("a full disk, a read-only folder and a kill leave no half file") {
  for (const char* format : kFormats) {
    INFO(format);
    for (const std::string& fault : velum::formats::test::writer_faults([&](const auto& path) {
           stage(path).set("format", format).threads(1).run(full_cloud(20000));
         }))
      FAIL_CHECK(fault);
  }
}

TEST_CASE("an interrupted run leaves nothing") {
  const Folder folder;
  CHECK_THROWS(stage(folder / "a.pcd").cancelled().run(plain_cloud(10)));
  CHECK_FALSE(std::filesystem::exists(folder / "a.pcd"));
}

TEST_CASE("conformance") {
  for (const char* format : kFormats)
    for (const auto& fault :
         velum::test::conformance("io.write_cloud", {{"file", "a.dat"}, {"format", format}}))
      FAIL_CHECK(format << ": " << fault);
}
