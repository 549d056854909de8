// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "formats/test_stages.hpp"

using velum::Error;
using velum::Fault;
using velum::formats::test::fault_of;
using velum::formats::test::Folder;
using velum::formats::test::put;
using velum::test::Stage;

namespace {

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

Stage stage(const std::filesystem::path& file) {
  return velum::formats::test::stage_on("io.read_mesh", file);
}

}  // namespace

TEST_CASE("polygons become triangles") {
  const Folder folder;
  const auto outcome = stage(put(folder, "a.obj", kSquare)).run();
  CHECK(outcome.mesh().size() == 2);
  CHECK(outcome.measure("vertices") == 4.0);
  CHECK(outcome.measure("triangles") == 2.0);
}

TEST_CASE("units scale the file's lengths") {
  const Folder folder;
  const auto outcome = stage(put(folder, "a.obj", kSquare)).set("units", "mm").run();
  CHECK(outcome.mesh().positions()(0, 1) == 0.001F);
}

TEST_CASE("a left-handed mesh keeps its front") {
  const Folder folder;
  const auto outcome = stage(put(folder, "a.obj", kSquare)).set("handedness", "left").run();
  const auto& mesh = outcome.mesh();
  const auto corner = [&](velum::Index i) {
    return Eigen::Vector3f(mesh.positions().col(mesh.triangles()(i, 0)));
  };
  // Its front was +z, which has become +x.
  CHECK((corner(1) - corner(0)).cross(corner(2) - corner(0)).x() > 0.0F);
}

TEST_CASE("the content decides, not the name") {
  const Folder folder;
  CHECK(stage(put(folder, "a.ply", kSquare)).run().mesh().size() == 2);
}

TEST_CASE("a GLB file is in metres and right-handed, and says so when asked otherwise") {
  const Folder folder;
  const auto file = folder / "a.glb";
  velum::test::Stage write = velum::formats::test::stage_on("io.write_mesh", file);
  const auto mesh = stage(put(folder, "a.obj", kSquare)).run().mesh();
  write.run(mesh);
  CHECK(stage(file).set("units", "mm").run().mesh().positions() == mesh.positions());
  CHECK(fault_of(stage(file).set("handedness", "left")) == Fault::graph);
}

TEST_CASE("polygons without an area's worth of corners are left out with a warning") {
  const Folder folder;
  const auto outcome = stage(put(folder, "a.obj", kSquare + "f 1 2\n")).run();
  CHECK(outcome.mesh().size() == 2);
  CHECK(outcome.warnings.size() == 1);
}

TEST_CASE("bad content is a fault of the input") {
  const Folder folder;
  CHECK(fault_of(stage(put(folder, "a.obj", kSquare + "f 1 2 9\n"))) == Fault::input);
  CHECK(fault_of(stage(put(folder, "a.stl", ""))) == Fault::input);
  CHECK(fault_of(stage(put(folder, "a.xyz", "1 2 3\n"))) == Fault::input);
}

TEST_CASE("a missing file is refused") {
  const Folder folder;
  CHECK_THROWS_AS(stage(folder / "missing.ply").run(), Error);
  CHECK_THROWS_AS(Stage("io.read_mesh").run(), Error);
}

TEST_CASE("conformance") {
  const Folder folder;
  for (const auto& fault :
       velum::test::conformance("io.read_mesh", {{"file", put(folder, "a.obj", kSquare).string()}}))
    FAIL_CHECK(fault);
}
