// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/ply.hpp"

#include <catch2/catch.hpp>

#include "formats/test_tools.hpp"

using namespace velum;
using namespace velum::formats;
using Catch::Matchers::Contains;
using test::bytes_of;
using test::error_of;
using test::read;

namespace {

Mesh read_mesh(std::string_view content) {
  return test::read_mesh_text(content, "mesh.ply");
}

std::string mesh_error(std::string_view content) {
  return test::mesh_error_of(content, "mesh.ply");
}

std::string reversed(std::string bytes, std::size_t size) {
  for (auto at = bytes.begin(); at != bytes.end(); at += static_cast<std::ptrdiff_t>(size))
    std::reverse(at, at + static_cast<std::ptrdiff_t>(size));
  return bytes;
}

const std::string kSquare =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
    "z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

}  // namespace

TEST_CASE("an ascii PLY with CR-LF, comments and another element gives its vertices") {
  const Cloud cloud = read(
      "ply\r\nformat ascii 1.0\r\nobj_info num_cols 512\r\ncomment hello\r\nelement vertex 2\r\n"
      "property float x\r\nproperty float y\r\nproperty double z\r\nproperty uchar red\r\n"
      "property uchar green\r\nproperty uchar blue\r\nelement range_grid 3\r\n"
      "property list uchar int vertex_indices\r\nend_header\r\n"
      "1 2 3 10 20 30\r\n4 5 6 40 50 60\r\n0\r\n1 0\r\n2 0 1\r\n",
      "cloud.ply");
  REQUIRE(cloud.size() == 2);
  CHECK(cloud.positions().col(1) == Eigen::Vector3f(4, 5, 6));
  CHECK(cloud.column(column::kColour).as<std::uint8_t>()(2, 1) == 60);
}

TEST_CASE("elements with lists before the vertices are passed over") {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement grid 2\nproperty list uchar short values\n"
      "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  const std::string grid =
      bytes_of<std::uint8_t>({2}) + bytes_of<std::int16_t>({5, 6}) + bytes_of<std::uint8_t>({0});
  const Cloud cloud = read(header + grid + bytes_of<float>({1, 2, 3}), "cloud.ply");
  CHECK(cloud.positions().col(0) == Eigen::Vector3f(1, 2, 3));
  CHECK_THAT(error_of(header + grid, "cloud.ply"), Contains("ends within element 'vertex'"));
}

TEST_CASE("vertices may have lists of their own, in text and binary") {
  const std::string properties =
      "element vertex 2\nproperty float x\nproperty list uchar float w\nproperty float y\n"
      "property float z\nproperty int label\nend_header\n";
  const Cloud text =
      read("ply\nformat ascii 1.0\n" + properties + "1 2 9 9 2 3 7\n4 0 5 6 8\n", "c.ply");
  const std::string body = bytes_of<float>({1}) + bytes_of<std::uint8_t>({2}) +
                           bytes_of<float>({9, 9, 2, 3}) + bytes_of<int>({7}) +
                           bytes_of<float>({4}) + bytes_of<std::uint8_t>({0}) +
                           bytes_of<float>({5, 6}) + bytes_of<int>({8});
  const Cloud binary = read("ply\nformat binary_little_endian 1.0\n" + properties + body, "c.ply");
  for (const Cloud& cloud : {text, binary}) {
    REQUIRE(cloud.size() == 2);
    CHECK(cloud.positions().col(0) == Eigen::Vector3f(1, 2, 3));
    CHECK(cloud.positions().col(1) == Eigen::Vector3f(4, 5, 6));
    CHECK(cloud.labels()[1] == 8);
  }
}

TEST_CASE("big-endian files read the same") {
  const std::string header =
      "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty double x\nproperty int y\n"
      "property float z\nproperty ushort q\nend_header\n";
  const Cloud cloud =
      read(header + reversed(bytes_of<double>({1.5}), 8) + reversed(bytes_of<int>({-2}), 4) +
               reversed(bytes_of<float>({0.25F}), 4) + reversed(bytes_of<std::uint16_t>({700}), 2),
           "cloud.ply");
  CHECK(cloud.positions().col(0) == Eigen::Vector3f(1.5F, -2.0F, 0.25F));
  CHECK(cloud.column("q").vector<int>()[0] == 700);
}

TEST_CASE("a first data byte that is a line end belongs to the data") {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty uchar x\nproperty uchar y\n"
      "property uchar z\nend_header\n";
  CHECK(read(header + "\n\n\n", "cloud.ply").positions().col(0) == Eigen::Vector3f(10, 10, 10));
}

TEST_CASE("polygons of a mesh become fans of triangles") {
  const Mesh mesh = read_mesh(kSquare + "4 0 1 2 3\n");
  REQUIRE(mesh.size() == 2);
  CHECK(mesh.triangles().col(0) == Eigen::Vector3i(0, 1, 2));
  CHECK(mesh.triangles().col(1) == Eigen::Vector3i(0, 2, 3));
}

TEST_CASE("a face that names no vertex is refused with its line") {
  CHECK_THAT(mesh_error(kSquare + "3 0 1 4\n"),
             Contains("mesh.ply:14: a face with a vertex out of range"));
  CHECK_THAT(mesh_error(kSquare + "3 0 1 -1\n"), Contains("out of range"));
  CHECK_THAT(mesh_error(kSquare + "200 0 1 2\n"), Contains("a list of 200 values"));
}

TEST_CASE("a mesh without faces, or with a vertex that is not finite, is refused") {
  CHECK_THAT(
      mesh_error("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                 "property float z\nend_header\n1 2 3\n"),
      Contains("no element 'face'"));
  std::string content = kSquare + "3 0 1 2\n";
  content.replace(content.find("0 1 0\n"), 5, "0 nan 0");
  CHECK_THAT(mesh_error(content), Contains("1 of 4 vertices have no finite coordinates"));
}

TEST_CASE("bad PLY headers are refused with their line") {
  CHECK_THAT(error_of("ply\nformat ascii\nend_header\n", "c.ply"), Contains("c.ply:2"));
  CHECK_THAT(error_of("ply\nformat ascii 1.0\nproperty float x\nend_header\n", "c.ply"),
             Contains("c.ply:3: a property before any element"));
  CHECK_THAT(error_of("ply\nformat ascii 1.0\nelement vertex -4\nend_header\n", "c.ply"),
             Contains("c.ply:3"));
  CHECK_THAT(error_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n", "c.ply"),
             Contains("c.ply:4"));
  CHECK_THAT(error_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n",
                      "c.ply"),
             Contains("no column 'y'"));
  CHECK_THAT(error_of("ply\nformat ascii 1.0\n", "c.ply"), Contains("no end_header"));
}

TEST_CASE("text lines must be as many as promised") {
  CHECK_THAT(mesh_error(kSquare), Contains("found 4 lines of data, expected 5"));
  CHECK_THAT(mesh_error(kSquare + "3 0 1 2\n3 0 1 2\n"), Contains("found 6 lines"));
}
