// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/text.hpp"

#include <catch2/catch.hpp>

#include "formats/test_tools.hpp"

using namespace velum;
using namespace velum::formats;
using Catch::Matchers::Contains;
using test::error_of;

namespace {

Cloud read(std::string_view content, const ReadOptions& options = {}) {
  return test::read(content, "cloud.txt", options);
}

std::string error(std::string_view content, const ReadOptions& options = {}) {
  return error_of(content, "cloud.txt", options);
}

}  // namespace

TEST_CASE("plain x y z, with blanks, tabs, CR-LF, blank lines and comments") {
  const Cloud cloud = read("# a scan\n// of something\n1 2 3\r\n\n  4\t5   6  \n# between\n7 8 9");
  REQUIRE(cloud.size() == 3);
  CHECK(cloud.positions().col(1) == Eigen::Vector3f(4, 5, 6));
  CHECK(cloud.columns().empty());
}

TEST_CASE("a header names the columns, in any order, quoted or with units") {
  const Cloud cloud = read("\"Z\";\"Y\";X [m];Label;note\n3;2;1;7;0.5\n6;5;4;8;1\n");
  CHECK(cloud.positions().col(0) == Eigen::Vector3f(1, 2, 3));
  CHECK(cloud.labels()[1] == 8);
  CHECK(cloud.column("note").vector<double>()[0] == 0.5);
}

TEST_CASE("a comment may name the columns") {
  const Cloud cloud = read("//X Y Z Intensity\n1 2 3 40\n");
  CHECK(cloud.intensity()[0] == 40.0F);
}

TEST_CASE("the parameter columns names them, and leaves some out") {
  ReadOptions options;
  options.columns = {"_", "x", "y", "z", "intensity"};
  const Cloud cloud = read("9 1 2 3 40\n", options);
  CHECK(cloud.positions().col(0) == Eigen::Vector3f(1, 2, 3));
  CHECK(cloud.intensity()[0] == 40.0F);
  CHECK(cloud.columns().size() == 1);
  CHECK_THAT(error("1 2 3\n", options), Contains("found 3 columns, expected 5"));
  options.columns = {"a", "b", "c"};
  CHECK_THAT(error("1 2 3\n", options), Contains("no x, y and z"));
}

TEST_CASE("columns without names are guessed from their values") {
  CHECK(read("1 2 3 0.5\n").has(column::kIntensity));
  CHECK(read("1 2 3 255 0 17\n4 5 6 1 2 3\n").has(column::kColour));
  CHECK(read("1 2 3 0.6 0 -0.8\n").has(column::kNormals));
  const Cloud other = read("1 2 3 10.5 0 17\n");
  CHECK(other.column("column_4").vector<double>()[0] == 10.5);
  CHECK(other.column("column_6").vector<int>()[0] == 17);
  const Cloud ten = read("1 2 3 9 255 0 17 0 0 1\n");
  CHECK((ten.has(column::kIntensity) && ten.has(column::kColour) && ten.has(column::kNormals)));
}

TEST_CASE("a PTS file counts its points first") {
  CHECK(read("2\n1 2 3 -10 1 2 3\n4 5 6 -20 4 5 6\n").intensity()[1] == -20.0F);
  CHECK_THAT(error("3\n1 2 3\n4 5 6\n"), Contains("found 2 lines of points, expected 3"));
}

TEST_CASE("empty cells of a table are missing values") {
  Source source("cloud.csv", std::string_view("x,y,z,q\n1,2,3,\n,5,6,1.5\n"));
  run::LocalContext context(1, 1);
  const Cloud cloud = read_cloud(source, {}, context);
  REQUIRE(cloud.size() == 1);
  CHECK(std::isnan(cloud.column("q").vector<double>()[0]));
  CHECK(context.measures().at("dropped").value == 1.0);
}

TEST_CASE("an empty last cell is read, too") {
  CHECK(read("x,y,z,q\n1,2,3,\n").size() == 1);
  CHECK_THAT(error("x,y,z,q\n1,2,3\n"), Contains("cloud.txt:1: 4 names for 3 columns"));
}

TEST_CASE("lines that do not fit are refused with their number") {
  CHECK_THAT(error("1 2 3\n1 2\n"), Contains("cloud.txt:2: found 2 values, expected 3"));
  CHECK_THAT(error("1 2 3\n1 2 3 4\n"), Contains("cloud.txt:2"));
  CHECK_THAT(error("1 2 3\n\n# c\n1 b 3\n"), Contains("cloud.txt:4: value 2 is 'b'"));
  CHECK_THAT(error("1 2\n"), Contains("found 2 values on a line, expected at least x, y and z"));
  CHECK_THAT(error("x y\n1 2\n"), Contains("no x, y and z"));
  CHECK_THAT(error("x y z w\n1 2 3\n"), Contains("4 names for 3 columns"));
  CHECK_THAT(error("x y z x\n1 2 3 4\n"), Contains("two columns called 'x'"));
  CHECK_THAT(error("# nothing\n\n"), Contains("no line of points"));
  CHECK_THAT(error("This is a sentence.\n"), !Contains("another fault") && Contains("cloud.txt"));
}

TEST_CASE("decimal commas are refused") {
  CHECK_THAT(error("1,5;2,5;3,5\n"), Contains("value 1 is"));
}

TEST_CASE("a long file is read in blocks, in order") {
  std::string content;
  for (int i = 0; i < 60000; ++i)
    content += std::to_string(i) + ".5 0.25 -" + std::to_string(i) + "\n";
  const Cloud cloud = read(content);
  REQUIRE(cloud.size() == 60000);
  CHECK(cloud.positions()(0, 59999) + static_cast<float>(cloud.origin().x()) == 59999.5F);
  content += "oops\n";
  CHECK_THAT(error(content), Contains("cloud.txt:60001"));
}
