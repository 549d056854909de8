// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "formats/test_faults.hpp"
#include "formats/test_stages.hpp"

using velum::Error;
using velum::Mesh;
using velum::formats::test::Folder;
using velum::formats::test::full_mesh;
using velum::formats::test::read_mesh_file;
using velum::test::Stage;

namespace {

Stage stage(const std::filesystem::path& file) {
  return velum::formats::test::stage_on("io.write_mesh", file);
}

constexpr const char* kFormats[] = {"ply", "ply_ascii", "stl",       "stl_ascii", "obj",
                                    "off", "vtk",       "vtk_ascii", "glb"};

}  // namespace

TEST_CASE("every format is written and read back") {
  const Folder folder;
  const Mesh mesh = full_mesh(500);
  for (const char* format : kFormats) {
    INFO(format);
    const auto outcome = stage(folder / "mesh.dat").set("format", format).run(mesh);
    CHECK(outcome.measure("triangles") == 498.0);
    CHECK(outcome.measure("vertices") == 500.0);
    CHECK(read_mesh_file(folder / "mesh.dat").positions() == mesh.positions());
  }
}

TEST_CASE("the extension chooses the format") {
  const Folder folder;
  for (const char* name : {"a.ply", "a.stl", "a.obj", "a.off", "a.vtk", "a.glb"}) {
    INFO(name);
    stage(folder / name).run(full_mesh(10));
    CHECK(read_mesh_file(folder / name).size() == 8);
  }
  CHECK_THROWS_AS(stage(folder / "a.pcd").run(full_mesh(10)), Error);
}

TEST_CASE("coordinates are in the unit asked for") {
  const Folder folder;
  stage(folder / "a.stl").set("units", "mm").run(full_mesh(10));
  CHECK(read_mesh_file(folder / "a.stl").positions().isApprox(full_mesh(10).positions() * 1000.0F));
}

TEST_CASE("GLB is in metres, whatever the unit") {
  const Folder folder;
  stage(folder / "a.glb").set("units", "mm").run(full_mesh(10));
  CHECK(read_mesh_file(folder / "a.glb").positions() == full_mesh(10).positions());
}

TEST_CASE("large coordinates in STL are warned about") {
  const Folder folder;
  const Mesh mesh = full_mesh(10, Eigen::Vector3d(5e6, 0, 0));
  CHECK(stage(folder / "a.stl").run(mesh).warnings.size() == 1);
  CHECK(stage(folder / "a.ply").run(mesh).warnings.empty());
}

TEST_CASE("an earlier file of that name is replaced, a folder is not") {
  const Folder folder;
  stage(folder / "a.ply").run(full_mesh(10));
  stage(folder / "a.ply").run(full_mesh(20));
  CHECK(read_mesh_file(folder / "a.ply").size() == 18);
  std::filesystem::create_directory(folder / "b.ply");
  CHECK_THROWS_AS(stage(folder / "b.ply").run(full_mesh(10)), Error);
}

TEST_CASE("a full disk, a read-only folder and a kill leave no half file") {
  const Mesh mesh = full_mesh(5000);
  for (const char* format : kFormats) {
    INFO(format);
    for (const std::string& fault : velum::formats::test::writer_faults(
             [&](const auto& path) { stage(path).set("format", format).threads(1).run(mesh); }))
      FAIL_CHECK(fault);
  }
}

TEST_CASE("an interrupted run leaves nothing") {
  const Folder folder;
  CHECK_THROWS(stage(folder / "a.ply").cancelled().run(full_mesh(10)));
  CHECK_FALSE(std::filesystem::exists(folder / "a.ply"));
}

TEST_CASE("conformance") {
  for (const char* format : kFormats)
    for (const auto& fault :
         velum::test::conformance("io.write_mesh", {{"file", "a.dat"}, {"format", format}}))
      FAIL_CHECK(format << ": " << fault);
}
