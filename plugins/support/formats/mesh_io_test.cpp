// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/mesh_io.hpp"

#include <catch2/catch.hpp>

#include "formats/test_tools.hpp"

using namespace velum;
using namespace velum::formats;
using Catch::Matchers::Contains;
using test::bytes_of;
using test::mesh_error_of;
using test::read_mesh_file;
using test::read_mesh_text;

namespace {

void write(const std::filesystem::path& path, const Mesh& mesh,
           MeshFormat format = MeshFormat::automatic, double unit = 1.0) {
  run::LocalContext context(2, 1);
  write_mesh(path, mesh, format, unit, context);
}

constexpr MeshFormat kFormats[] = {MeshFormat::ply,       MeshFormat::ply_ascii, MeshFormat::stl,
                                   MeshFormat::stl_ascii, MeshFormat::obj,       MeshFormat::off,
                                   MeshFormat::vtk,       MeshFormat::vtk_ascii, MeshFormat::glb};

const std::string kBox = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string stl_triangle(std::initializer_list<float> corners) {
  return bytes_of<float>({0, 0, 0}) + bytes_of<float>(corners) + std::string(2, '\0');
}

}  // namespace

TEST_CASE("a mesh is read back from every format") {
  const test::Folder folder;
  const Mesh mesh = test::full_mesh(20000);
  for (const MeshFormat format : kFormats) {
    INFO(static_cast<int>(format));
    write(folder / "mesh.dat", mesh, format);
    const Mesh back = read_mesh_file(folder / "mesh.dat");
    REQUIRE(back.size() == mesh.size());
    CHECK(back.vertices().size() == mesh.vertices().size());
    // STL numbers its vertices anew, in the order of the triangles: here the same.
    CHECK(back.triangles() == mesh.triangles());
    CHECK(back.positions() == mesh.positions());
  }
}

TEST_CASE("columns of a mesh's vertices survive where the format has them") {
  const test::Folder folder;
  const Mesh mesh = test::full_mesh(300);
  for (const MeshFormat format : {MeshFormat::ply, MeshFormat::ply_ascii, MeshFormat::vtk}) {
    write(folder / "mesh.dat", mesh, format);
    const Cloud back = read_mesh_file(folder / "mesh.dat").vertices();
    CHECK(back.normals() == mesh.vertices().normals());
    CHECK(back.labels() == mesh.vertices().labels());
    CHECK(back.column("histogram").as<float>() == mesh.vertices().column("histogram").as<float>());
  }
  write(folder / "mesh.obj", mesh);
  const Cloud back = read_mesh_file(folder / "mesh.obj").vertices();
  CHECK(back.normals() == mesh.vertices().normals());
  CHECK(back.column(column::kColour).as<std::uint8_t>() ==
        mesh.vertices().column(column::kColour).as<std::uint8_t>());
}

TEST_CASE("large coordinates of a mesh are kept, but for STL, which says so") {
  const test::Folder folder;
  const Eigen::Vector3d place(512345.0, 5413211.0, 0.0);
  const Mesh mesh = test::full_mesh(300, place);
  for (const MeshFormat format : kFormats) {
    INFO(static_cast<int>(format));
    run::LocalContext context(2, 1);
    write_mesh(folder / "mesh.dat", mesh, format, 1.0, context);
    const bool stl = format == MeshFormat::stl || format == MeshFormat::stl_ascii;
    CHECK(context.warnings().size() == (stl ? 1U : 0U));
    if (stl) continue;
    const Mesh back = read_mesh_file(folder / "mesh.dat");
    const Eigen::Matrix3Xd error =
        (back.positions().cast<double>().colwise() + (back.origin() - place)) -
        mesh.positions().cast<double>();
    CHECK(error.cwiseAbs().maxCoeff() < 2.5e-7);
  }
}

TEST_CASE("units and handedness of a mesh") {
  ReadOptions options;
  options.unit = 0.001;
  options.left_handed = true;
  const Mesh mesh = read_mesh_text(kBox + "f 1 2 3\n", "m.obj", options);
  CHECK(mesh.positions().col(2).isApprox(Eigen::Vector3f(0, -0.001F, 0.001F)));
  CHECK(mesh.triangles().col(0) == Eigen::Vector3i(0, 2, 1));
  const test::Folder folder;
  write(folder / "m.off", mesh, MeshFormat::automatic, 0.001);
  CHECK(read_mesh_file(folder / "m.off").positions().isApprox(mesh.positions() * 1000.0F));
}

TEST_CASE("polygons, negative numbers, normals and texture of OBJ") {
  const Mesh mesh = read_mesh_text("mtllib a.mtl\n" + kBox +
                                   "vt 0 0\nvn 0 0 1\no box\ng a b\nusemtl wood\ns off\n"
                                   "f 1/1/1 2/1/1 3/1/1 4/1/1\nf -4//-1 -3//1 -2//-1\nl 1 2\n");
  CHECK(mesh.size() == 3);
  CHECK(mesh.triangles().col(2) == Eigen::Vector3i(0, 1, 2));
  CHECK(mesh.vertices().normals().col(3) == Eigen::Vector3f(0, 0, 1));
}

TEST_CASE("vertices with several normals get none; colours are read") {
  CHECK_FALSE(read_mesh_text(kBox + "vn 0 0 1\nvn 1 0 0\nf 1//1 2//1 3//1\nf 1//2 3//1 4//1\n")
                  .vertices()
                  .has(column::kNormals));
  const Mesh mesh = read_mesh_text("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 0.5\nf 1 2 3\n");
  CHECK(mesh.vertices().column(column::kColour).as<std::uint8_t>()(2, 2) == 128);
}

TEST_CASE("bad OBJ files are refused with their line") {
  CHECK_THAT(mesh_error_of(kBox + "f 0 1 2\n"), Contains("mesh.obj:5: a face refers to '0'"));
  CHECK_THAT(mesh_error_of(kBox + "f 1 2 5\n"), Contains("refers to '5'"));
  CHECK_THAT(mesh_error_of(kBox + "f 1 2 -5\n"), Contains("refers to '-5'"));
  CHECK_THAT(mesh_error_of("v 1 2\n"), Contains("a vertex of 2 numbers"));
  CHECK_THAT(mesh_error_of("v 1 2 x\n"), Contains("found 'x'"));
  CHECK_THAT(mesh_error_of(kBox + "nonsense 1\n"), Contains("found 'nonsense'"));
  CHECK_THAT(mesh_error_of(kBox), Contains("no faces"));
  CHECK_THAT(mesh_error_of("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), Contains("no finite"));
}

TEST_CASE("a binary STL merges equal vertices, negative zero too, even when it begins with solid") {
  std::string header = "solid but binary";
  header.resize(80, ' ');
  const std::string content = header + bytes_of<std::uint32_t>({2}) +
                              stl_triangle({0, 0, 0, 1, 0, 0, 0, 1, 0}) +
                              stl_triangle({1, 0, 0, 1, 1, 0, -0.0F, 1, -0.0F});
  const Mesh mesh = read_mesh_text(content, "m.stl");
  CHECK(mesh.vertices().size() == 4);
  CHECK(mesh.triangles().col(1) == Eigen::Vector3i(1, 3, 2));
}

TEST_CASE("a text STL may have several solids") {
  const std::string one =
      "solid a\n FACET normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0\n"
      " endloop\n endfacet\nendsolid a\n";
  CHECK(read_mesh_text(one + one, "m.stl").size() == 2);
  CHECK_THAT(mesh_error_of(one.substr(0, one.size() - 20), "m.stl"), Contains("m.stl:"));
  std::string bad = one;
  bad.replace(bad.find("vertex 0 1 0"), 12, "vertex 0 1 x");
  CHECK_THAT(mesh_error_of(bad, "m.stl"), Contains("m.stl:6"));
  CHECK_THAT(
      mesh_error_of("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\n", "m.stl"),
      Contains("a loop of 1 vertices"));
}

TEST_CASE("OFF with colours, normals, comments and counts on the first line") {
  const std::string faces = "3 0 1 2 255 0 0\n";
  CHECK(read_mesh_text("OFF 3 1 0\n# c\n0 0 0\n1 0 0\n0 1 0\n" + faces, "m.off").size() == 1);
  const Mesh coloured = read_mesh_text(
      "COFF\n3 1 0\n0 0 0 9 8 7 255\n1 0 0 9 8 7 255\n0 1 0 9 8 6 255\n" + faces, "m.off");
  CHECK(coloured.vertices().column(column::kColour).as<std::uint8_t>()(2, 2) == 6);
  CHECK(read_mesh_text("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n" + faces, "m.off")
            .vertices()
            .has(column::kNormals));
}

TEST_CASE("bad OFF files are refused with their line") {
  CHECK_THAT(mesh_error_of("OFF\n3 4\n0 0 0\n", "m.off"), Contains("m.off:2"));
  CHECK_THAT(mesh_error_of("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "m.off"),
             Contains("out of range"));
  CHECK_THAT(mesh_error_of("OFF\n3 1 0\n0 0 0\n1 0 0\n", "m.off"),
             Contains("found 2 lines of data"));
  CHECK_THAT(mesh_error_of("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n900000000 0 1\n", "m.off"),
             Contains("m.off:6"));
}

TEST_CASE("a cloud is no mesh") {
  CHECK_THAT(mesh_error_of("1 2 3\n4 5 6\n", "m.txt"), Contains("a text file has no mesh"));
}
