// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/pcd.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "formats/lzf.hpp"
#include "formats/test_tools.hpp"

using namespace velum;
using namespace velum::formats;
using Catch::Matchers::Contains;
using test::bytes_of;
using test::error_of;
using test::read;

namespace {

std::string header(const std::string& points, const std::string& data) {
  return "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + points +
         "\nHEIGHT 1\nPOINTS " + points + "\nDATA " + data + "\n";
}

}  // namespace

TEST_CASE("an ascii PCD gives its points") {
  const Cloud cloud = read(header("2", "ascii") + "1 2 3\n-4.5 5e-1 +6\n");
  REQUIRE(cloud.size() == 2);
  CHECK(cloud.positions().col(1) == Eigen::Vector3f(-4.5F, 0.5F, 6.0F));
  CHECK(cloud.sensors().empty());
}

TEST_CASE("bodies may be separated by tabs or commas and end in CR-LF") {
  const Cloud cloud = read(header("2", "ascii") + "1\t2\t3\r\n4,5,6");
  CHECK(cloud.positions().col(1) == Eigen::Vector3f(4, 5, 6));
}

TEST_CASE("fields come in any order, size and type, with upper-case coordinates") {
  const std::string body = bytes_of<std::uint16_t>({700}) + bytes_of<double>({3.0}) +
                           bytes_of<double>({2.0}) + bytes_of<double>({1.0}) +
                           bytes_of<std::int8_t>({-5}) + bytes_of<std::uint32_t>({0x00FF8001}) +
                           bytes_of<float>({0.5F, 0.25F}) + bytes_of<std::uint64_t>({9}) +
                           bytes_of<std::uint8_t>({77});
  const Cloud cloud = read(
      "FIELDS Intensity Z Y X label rgba shape stamp _\nSIZE 2 8 8 8 1 4 4 8 1\n"
      "TYPE U F F F I U F U U\nCOUNT 1 1 1 1 1 1 2 1 1\nWIDTH 1\nHEIGHT 1\nDATA binary\n" +
      body);
  REQUIRE(cloud.size() == 1);
  CHECK(cloud.positions().col(0) == Eigen::Vector3f(1, 2, 3));
  CHECK(cloud.intensity()[0] == 700.0F);
  CHECK(cloud.labels()[0] == -5);
  CHECK(cloud.column(column::kColour).as<std::uint8_t>().col(0) ==
        Eigen::Matrix<std::uint8_t, 3, 1>(255, 128, 1));
  CHECK(cloud.column("shape").as<float>().col(0) == Eigen::Vector2f(0.5F, 0.25F));
  CHECK(cloud.column("stamp").vector<int>()[0] == 9);
  CHECK_FALSE(cloud.has("_"));
}

TEST_CASE("points without finite coordinates are dropped with their columns and counted") {
  Source source(
      "cloud.pcd",
      std::string_view("FIELDS label x y z\nSIZE 4 4 4 4\nTYPE U F F F\nWIDTH 2\nHEIGHT 2\n"
                       "POINTS 4\nDATA ascii\n0 nan nan nan\n7 1 2 3\n0 1 inf 2\n8 4 5 6\n"));
  run::LocalContext context(2, 1);
  const Cloud cloud = read_cloud(source, {}, context);
  REQUIRE(cloud.size() == 2);
  CHECK(cloud.labels()[1] == 8);
  CHECK(context.measures().at("dropped").value == 2.0);
  REQUIRE(context.warnings().size() == 1);
  CHECK_THAT(context.warnings()[0], Contains("2 of 4 points"));
}

TEST_CASE("a cloud of which nothing is finite is empty") {
  CHECK(read(header("2", "ascii") + "nan 0 0\n0 nan 0\n").empty());
}

TEST_CASE("VIEWPOINT is the sensor's pose, in the file's unit") {
  ReadOptions options;
  options.unit = 0.001;
  const Cloud cloud = read(
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\n"
      "VIEWPOINT 1000 2000 3000 0 0 0 1\nPOINTS 1\nDATA ascii\n1000 0 0\n",
      "cloud.pcd", options);
  REQUIRE(cloud.sensors().size() == 1);
  CHECK(cloud.sensors()[0].pose.translation().isApprox(Eigen::Vector3d(1, 2, 3)));
  CHECK((cloud.sensors()[0].pose.linear() * Eigen::Vector3d::UnitX())
            .isApprox(-Eigen::Vector3d::UnitX()));
  CHECK(cloud.positions()(0, 0) == 1.0F);
}

TEST_CASE("large coordinates get an origin and keep all digits of the text") {
  const Cloud cloud = read(header("2", "ascii") +
                           "289814.15 4320978.61 170.76\n"
                           "289815.60 4320979.28 170.74\n");
  CHECK(cloud.origin().x() == 289815.0);
  CHECK(cloud.origin().z() == 0.0);
  const Eigen::Vector3d second = cloud.origin() + cloud.positions().col(1).cast<double>();
  CHECK((second - Eigen::Vector3d(289815.60, 4320979.28, 170.74)).cwiseAbs().maxCoeff() < 1e-5);
}

TEST_CASE("LZF packs and unpacks any bytes") {
  std::vector<std::byte> bytes;
  std::uint32_t state = 1;
  for (int i = 0; i < 100000; ++i) {
    state = state * 1664525U + 1013904223U;
    bytes.push_back(static_cast<std::byte>(i % 3 == 0 ? state >> 24U : (i / 500) & 255));
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{5}, bytes.size()}) {
    const std::span<const std::byte> in(bytes.data(), size);
    const std::vector<std::byte> packed = lzf_pack(in);
    std::vector<std::byte> out(size);
    REQUIRE(lzf_unpack(packed, out));
    CHECK(std::equal(out.begin(), out.end(), in.begin()));
  }
  const std::vector<std::byte> zeros(100000);
  CHECK(lzf_pack(zeros).size() < zeros.size() / 80);
}

TEST_CASE("damaged LZF data are refused") {
  std::vector<std::byte> out(100);
  const auto unpack = [&](std::initializer_list<int> bytes) {
    std::vector<std::byte> in;
    for (const int b : bytes) in.push_back(static_cast<std::byte>(b));
    return lzf_unpack(in, out);
  };
  CHECK_FALSE(unpack({0x20, 0x00}));             // refers to before the beginning
  CHECK_FALSE(unpack({0x05, 1, 2}));             // literal cut short
  CHECK_FALSE(unpack({0xE0}));                   // match cut short
  CHECK_FALSE(unpack({0x00, 1}));                // too little
  CHECK_FALSE(unpack({0x00, 1, 0xE0, 200, 0}));  // too much
}

TEST_CASE("a bad header is refused with its line") {
  CHECK_THAT(error_of("VERSION 0.7\nFIELDS x y z\nSIZE 4 4\n"), Contains("no DATA entry"));
  CHECK_THAT(
      error_of("VERSION 0.7\nFIELDS x y z\nSIZE 4 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n1 2 3"),
      Contains("cloud.pcd:3: SIZE has 2 entries for 3 fields"));
  CHECK_THAT(error_of(header("-1", "ascii")), Contains("cloud.pcd:6"));
  CHECK_THAT(error_of(header("1", "zipped")), Contains("cloud.pcd:9"));
}

TEST_CASE("counts that the file cannot hold are refused before anything is allocated") {
  CHECK_THAT(error_of(header("2000000000", "binary") + "abc"), Contains("3 of 24000000000 bytes"));
  CHECK_THAT(error_of(header("2000000000", "ascii") + "1 2 3\n"),
             Contains("found 1 lines of points, expected 2000000000"));
  CHECK_THAT(error_of(header("300000000", "binary_compressed") +
                      bytes_of<std::uint32_t>({2, 3600000000U}) + "ab"),
             Contains("said to hold"));
}

TEST_CASE("a bad value is refused with its line") {
  CHECK_THAT(error_of(header("2", "ascii") + "1 2 3\n1 2 three\n"),
             Contains("cloud.pcd:11: value 3 is 'three'"));
  CHECK_THAT(error_of(header("1", "ascii") + "1 2\n"), Contains("found 2 values, expected 3"));
  CHECK_THAT(error_of(header("1", "ascii") + "1 2 3 4\n"), Contains("found '4' after"));
}

TEST_CASE("data after the last point are refused, blanks are not") {
  const std::string points = bytes_of<float>({1, 2, 3});
  CHECK(read(header("1", "binary") + points + std::string("\n\0\0", 3)).size() == 1);
  CHECK_THAT(error_of(header("1", "binary") + points + "more"), Contains("byte"));
}
