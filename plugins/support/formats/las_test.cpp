// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/las.hpp"

#include <catch2/catch.hpp>

#include "formats/test_tools.hpp"

using namespace velum;
using namespace velum::formats;
using Catch::Matchers::Contains;
using test::bytes_of;
using test::error_of;

namespace {

struct Las {
  int minor = 2;
  int format = 3;
  std::uint16_t length = 34;
  std::uint32_t count = 2;
  std::uint64_t count14 = 0;
  double scale = 0.01;
  double offset = 5e6;
  std::string points;
  std::string between;  // variable-length records

  template <class T>
  static void put(std::string& bytes, std::size_t at, T value) {
    std::memcpy(bytes.data() + at, &value, sizeof(T));
  }

  [[nodiscard]] std::string content() const {
    const std::uint16_t size = minor == 4 ? 375 : minor == 3 ? 235 : 227;
    std::string header(size, '\0');
    header.replace(0, 4, "LASF");
    put<std::uint8_t>(header, 24, 1);
    put(header, 25, static_cast<std::uint8_t>(minor));
    put(header, 94, size);
    put(header, 96, static_cast<std::uint32_t>(size + between.size()));
    put(header, 104, static_cast<std::uint8_t>(format));
    put(header, 105, length);
    put(header, 107, count);
    for (std::size_t a = 0; a < 3; ++a) {
      put(header, 131 + 8 * a, scale);
      put(header, 155 + 8 * a, offset);
    }
    if (minor == 4) put(header, 247, count14);
    return header + between + points;
  }

  void add(int x, int y, int z, std::uint16_t intensity, std::uint8_t classification) {
    std::string point(length, '\0');
    put(point, 0, x);
    put(point, 4, y);
    put(point, 8, z);
    put(point, 12, intensity);
    const bool late = format >= 6;
    put(point, late ? 16 : 15, classification);
    if (format == 3 || format >= 6) put(point, late ? 22 : 20, 12345.5);
    if (format == 3 || format == 7) put<std::uint16_t>(point, late ? 30 : 28, 65535);
    points += point;
  }
};

Las two_points() {
  Las las;
  las.add(12345678, -5, 7, 300, 2 + 32);
  las.add(12345999, 15, 9, 400, 6);
  return las;
}

}  // namespace

TEST_CASE("positions of a LAS file are exact to its scale") {
  const Cloud cloud = test::read(two_points().content(), "c.las");
  REQUIRE(cloud.size() == 2);
  const Eigen::Matrix3Xd places = cloud.positions().cast<double>().colwise() + cloud.origin();
  CHECK(places(0, 0) == Approx(12345678 * 0.01 + 5e6).margin(1e-6));
  CHECK(std::lround((places(0, 1) - 5e6) / 0.01) == 12345999);
  CHECK(std::lround((places(1, 0) - 5e6) / 0.01) == -5);
  // The origin lies on the file's grid.
  CHECK(std::abs(std::remainder(cloud.origin().x() - 5e6, 0.01)) < 1e-9);
}

TEST_CASE("attributes of a LAS point") {
  const Cloud cloud = test::read(two_points().content(), "c.las");
  CHECK(cloud.intensity()[1] == 400.0F);
  CHECK(cloud.labels()[0] == 2);
  CHECK(cloud.labels()[1] == 6);
  CHECK(cloud.column(column::kTime).vector<double>()[0] == 12345.5);
  CHECK(cloud.column(column::kColour).as<std::uint8_t>()(0, 1) == 255);
}

TEST_CASE("all versions, with records between header and points, and extra bytes a point") {
  for (const int minor : {0, 1, 2, 3, 4}) {
    Las las;
    las.minor = minor;
    las.format = minor == 4 ? 7 : 0;
    las.length = static_cast<std::uint16_t>(minor == 4 ? 40 : 23);
    las.between = std::string(100, 'v');
    las.count14 = 1;
    las.count = minor == 4 ? 0 : 1;
    las.add(1, 2, 3, 4, 5);
    const Cloud cloud = test::read(las.content(), "c.las");
    INFO(minor);
    REQUIRE(cloud.size() == 1);
    CHECK(cloud.labels()[0] == 5);
    CHECK(cloud.has(column::kTime) == (minor == 4));
  }
}

TEST_CASE("a fine grid keeps its steps although its coordinates are small") {
  Las las;
  las.scale = 1e-6;
  las.offset = 0.0;
  las.add(900000001, 0, 0, 0, 0);
  las.add(900000002, 0, 0, 0, 0);
  const Cloud cloud = test::read(las.content(), "c.las");
  CHECK(cloud.positions()(0, 1) - cloud.positions()(0, 0) == Approx(1e-6).epsilon(1e-3));
}

TEST_CASE("a span that single precision cannot tell apart is warned about") {
  Las las;
  las.add(-2000000000, 0, 0, 0, 0);
  las.add(2000000000, 0, 0, 0, 0);
  const std::string content = las.content();
  Source source("c.las", std::string_view(content));
  run::LocalContext context(1, 1);
  CHECK(read_las(source, {}, context).size() == 2);
  REQUIRE(context.warnings().size() == 1);
  CHECK_THAT(context.warnings()[0], Contains("single precision"));
}

TEST_CASE("units of a LAS file") {
  ReadOptions options;
  options.unit = 0.3048;
  const Cloud cloud = test::read(two_points().content(), "c.las", options);
  CHECK(cloud.origin().x() + static_cast<double>(cloud.positions()(0, 0)) ==
        Approx((12345678 * 0.01 + 5e6) * 0.3048).margin(1e-4));
}

TEST_CASE("damaged LAS files are refused with their byte") {
  CHECK_THAT(error_of("LASF", "c.las"), Contains("at least 227 bytes"));
  std::string content = two_points().content();
  CHECK_THAT(error_of(content.substr(0, content.size() - 1), "c.las"), Contains("67 of 68 bytes"));
  const auto changed = [&](std::size_t at, auto value) {
    std::string copy = content;
    Las::put(copy, at, value);
    return error_of(copy, "c.las");
  };
  CHECK_THAT(changed(104, std::uint8_t{131}), Contains("LAZ"));
  CHECK_THAT(changed(104, std::uint8_t{11}), Contains("point format 11"));
  CHECK_THAT(changed(105, std::uint16_t{20}), Contains("has at least 34"));
  CHECK_THAT(changed(107, std::uint32_t{4000000000U}), Contains("4000000000 points"));
  CHECK_THAT(changed(107, std::uint32_t{2000000000U}), Contains("the file ends"));
  CHECK_THAT(changed(131, 0.0), Contains("a scale of 0"));
  CHECK_THAT(changed(155, std::numeric_limits<double>::infinity()), Contains("an offset of inf"));
  CHECK_THAT(changed(96, std::uint32_t{100}), Contains("points at byte 100"));
  CHECK_THAT(changed(25, std::uint8_t{9}), Contains("version 1.9"));
}
