// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/vtk.hpp"

#include <catch2/catch.hpp>

#include "formats/test_tools.hpp"

using namespace velum;
using namespace velum::formats;
using Catch::Matchers::Contains;
using test::error_of;
using test::mesh_error_of;
using test::read_mesh_text;

namespace {

Cloud read(std::string_view content) {
  return test::read(content, "cloud.vtk");
}

const std::string kStart =
    "# vtk DataFile Version 3.0\na title\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
    "0 0 0 1 0\n0\n0 1 0\n";

template <class T>
std::string big(std::initializer_list<T> values) {
  std::string all;
  for (const T value : values) {
    std::string bytes = test::bytes_of<T>({value});
    all.append(bytes.rbegin(), bytes.rend());
  }
  return all;
}

}  // namespace

TEST_CASE("points of a text VTK, however they are broken into lines") {
  const Cloud cloud = read(kStart + "VERTICES 3 6\n1 0\n1 1\n1 2\n");
  REQUIRE(cloud.size() == 3);
  CHECK(cloud.positions().col(2) == Eigen::Vector3f(0, 1, 0));
}

TEST_CASE("point data of every kind become columns") {
  const Cloud cloud =
      read(kStart +
           "CELL_DATA 1\nSCALARS c int\n1\nPOINT_DATA 3\nSCALARS intensity float 1\n"
           "LOOKUP_TABLE default\n1 2 3\nSCALARS label int\n7 8 9\nNORMALS n float\n"
           "0 0 1 0 0 1 0 0 1\nVECTORS speed double\n1 2 3 4 5 6 7 8 9\n"
           "COLOR_SCALARS c 3\n1 0 0 0 1 0 0 0 0.5\n"
           "FIELD data 2\nquality 1 3 unsigned_char\n1 2 3\npair 2 3 float\n"
           "1 2 3 4 5 6\nTEXTURE_COORDINATES t 2 float\n0 0 0 1 1 1\n");
  CHECK(cloud.intensity()[2] == 3.0F);
  CHECK(cloud.labels()[0] == 7);
  CHECK(cloud.normals().col(1) == Eigen::Vector3f(0, 0, 1));
  CHECK(cloud.column("speed").as<double>()(1, 1) == 5.0);
  CHECK(cloud.column(column::kColour).as<std::uint8_t>()(2, 2) == 128);
  CHECK(cloud.column("quality").vector<std::uint8_t>()[1] == 2);
  CHECK(cloud.column("pair").as<float>()(0, 2) == 5.0F);
  CHECK(cloud.column("t").width() == 2);
}

TEST_CASE("a binary VTK is big-endian") {
  const std::string content =
      "# vtk DataFile Version 4.2\na title\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 double\n" +
      big<double>({0, 0, 0, 1, 0, 0, 0, 1, 0.5}) + "\nCELLS 1 4\n" + big<int>({3, 0, 1, 2}) +
      "\nCELL_TYPES 1\n" + big<int>({5}) +
      "\nPOINT_DATA 3\nSCALARS q short 1\nLOOKUP_TABLE default\n" + big<std::int16_t>({5, -6, 7}) +
      "\n";
  CHECK(read(content).positions()(2, 2) == 0.5F);
  CHECK(read(content).column("q").vector<int>()[1] == -6);
  CHECK(read_mesh_text(content, "m.vtk").triangles().col(0) == Eigen::Vector3i(0, 1, 2));
}

TEST_CASE("polygons, strips and the cells of version 5 become triangles") {
  CHECK(read_mesh_text(kStart + "POLYGONS 1 4\n3 0 1 2\n", "m.vtk").size() == 1);
  CHECK(read_mesh_text(kStart + "TRIANGLE_STRIPS 1 5\n4 0 1 2 0\n", "m.vtk").triangles().col(1) ==
        Eigen::Vector3i(2, 1, 0));
  CHECK(read_mesh_text(kStart +
                           "POLYGONS 2 3\nOFFSETS vtktypeint64\n0 3\nCONNECTIVITY vtktypeint64\n"
                           "2 1 0\n",
                       "m.vtk")
            .triangles()
            .col(0) == Eigen::Vector3i(2, 1, 0));
}

TEST_CASE("damaged VTK files are refused") {
  CHECK_THAT(error_of("# vtk DataFile Version 3.0\nt\nTEXT\n", "c.vtk"),
             Contains("expected ASCII or BINARY"));
  CHECK_THAT(error_of("# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\n", "c.vtk"),
             Contains("c.vtk:4"));
  CHECK_THAT(error_of("# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n", "c.vtk"),
             Contains("no POINTS"));
  CHECK_THAT(
      error_of("# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n1 2 x\n",
               "c.vtk"),
      Contains("do not fit") || Contains("found 'x'"));
  CHECK_THAT(error_of(kStart + "POINT_DATA 4\n", "c.vtk"), Contains("POINT_DATA for 4 points"));
  CHECK_THAT(error_of(kStart + "NONSENSE 4\n", "c.vtk"), Contains("found 'NONSENSE'"));
  CHECK_THAT(
      error_of(
          "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 700000000 float\n1234",
          "c.vtk"),
      Contains("bytes follow"));
  CHECK_THAT(mesh_error_of(kStart + "POLYGONS 1 4\n3 0 1 3\n", "m.vtk"), Contains("out of range"));
  CHECK_THAT(mesh_error_of(kStart + "POLYGONS 1 4\n9 0 1 2\n", "m.vtk"), Contains("lies outside"));
  CHECK_THAT(mesh_error_of(kStart, "m.vtk"), Contains("no polygons"));
}
