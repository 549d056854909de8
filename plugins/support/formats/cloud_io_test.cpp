// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/cloud_io.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "formats/test_tools.hpp"

using namespace velum;
using namespace velum::formats;
using Catch::Matchers::Contains;
using test::read;
using test::read_file;
using test::write;

namespace {

void check_same(const Cloud& a, const Cloud& b) {
  REQUIRE(a.size() == b.size());
  CHECK(a.positions() == b.positions());
  CHECK(a.origin() == b.origin());
  for (const auto& [name, column] : a.columns()) {
    INFO(name);
    REQUIRE(b.has(name));
    const Column& other = b.column(name);
    CHECK(name_of(column.scalar()) == name_of(other.scalar()));
    CHECK(column.width() == other.width());
    CHECK(std::equal(column.bytes().begin(), column.bytes().end(), other.bytes().begin(),
                     other.bytes().end()));
  }
  CHECK(a.columns().size() == b.columns().size());
  REQUIRE(a.sensors().size() == b.sensors().size());
  for (std::size_t i = 0; i < a.sensors().size(); ++i) {
    CHECK(a.sensors()[i].name == b.sensors()[i].name);
    CHECK(a.sensors()[i].pose.isApprox(b.sensors()[i].pose, 1e-12));
  }
}

struct Case {
  const char* name;
  CloudFormat format;
};
constexpr Case kTyped[] = {{"a.pcd", CloudFormat::pcd_ascii},
                           {"b.pcd", CloudFormat::pcd},
                           {"c.pcd", CloudFormat::pcd_compressed},
                           {"d.ply", CloudFormat::ply_ascii},
                           {"e.ply", CloudFormat::ply}};

}  // namespace

TEST_CASE("what is written with every column is read back the same") {
  const test::Folder folder;
  for (const Index count : {Index{1}, Index{2}, Index{1000}, Index{150001}}) {
    const Cloud cloud = test::full_cloud(count);
    for (const Case& one : kTyped) {
      INFO(one.name << " " << count);
      write(folder / one.name, cloud, one.format);
      check_same(cloud, read_file(folder / one.name));
    }
  }
}

TEST_CASE("text keeps every value; types of extra columns are those that the values need") {
  const test::Folder folder;
  const Cloud cloud = test::full_cloud(1000);
  for (const char* name : {"cloud.xyz", "cloud.csv"}) {
    INFO(name);
    write(folder / name, cloud);
    const Cloud back = read_file(folder / name);
    CHECK(back.positions() == cloud.positions());
    CHECK(back.normals() == cloud.normals());
    CHECK(back.labels() == cloud.labels());
    CHECK(back.column(column::kTime).vector<double>() ==
          cloud.column(column::kTime).vector<double>());
    CHECK(back.column("echo").vector<int>() == cloud.column("echo").vector<int>());
    CHECK(back.column("histogram").as<double>().cast<float>() ==
          cloud.column("histogram").as<float>());
    CHECK(back.columns().size() == cloud.columns().size() - (back.sensors().empty() ? 1 : 0) +
                                       (back.has("sensor_raw") ? 1 : 0));
  }
  CHECK(read_file(folder / "cloud.xyz").sensors().size() == 2);
}

TEST_CASE("VTK keeps every column, but no sensors") {
  const test::Folder folder;
  const Cloud cloud = test::full_cloud(70000).with_sensors({}).without(column::kSensor);
  for (const CloudFormat format : {CloudFormat::vtk, CloudFormat::vtk_ascii}) {
    write(folder / "cloud.vtk", cloud, format);
    check_same(cloud, read_file(folder / "cloud.vtk"));
  }
}

TEST_CASE("an empty cloud is written and read") {
  const test::Folder folder;
  for (const Case& one : kTyped) {
    INFO(one.name);
    write(folder / one.name, Cloud(), one.format);
    CHECK(read_file(folder / one.name).empty());
  }
}

TEST_CASE("large coordinates are written in double precision and lose nothing") {
  const test::Folder folder;
  const Eigen::Vector3d place(512345.0, 5413211.0, 0.0);
  const Cloud cloud = test::plain_cloud(500, place);
  for (const char* name : {"a.pcd", "b.ply", "c.xyz", "d.csv", "e.vtk"}) {
    INFO(name);
    write(folder / name, cloud);
    const Cloud back = read_file(folder / name);
    REQUIRE(back.size() == 500);
    const Eigen::Matrix3Xd error =
        (back.positions().cast<double>().colwise() + (back.origin() - place)) -
        cloud.positions().cast<double>();
    CHECK(error.cwiseAbs().maxCoeff() < 2.5e-7);
    CHECK(back.origin().y() > 5e6);
  }
}

TEST_CASE("a file of large single-precision coordinates is read without loss") {
  std::string content =
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 3\nHEIGHT 1\nDATA binary\n" +
      test::bytes_of<float>({512000.03125F, 5413211.5F, 270.1F, 512300.0F, 5413900.0F, 301.7F,
                             511999.90625F, 5413000.5F, 280.3F});
  const Cloud cloud = read(content);
  CHECK(cloud.origin().y() != 0.0);
  const Eigen::Matrix3Xd places = cloud.positions().cast<double>().colwise() + cloud.origin();
  CHECK(places(0, 0) == static_cast<double>(512000.03125F));
  CHECK(places(1, 2) == 5413000.5);
  CHECK(places(2, 1) == static_cast<double>(301.7F));
}

TEST_CASE("units scale what is read and written") {
  const test::Folder folder;
  const Cloud cloud = test::plain_cloud(100);
  ReadOptions millimetres;
  millimetres.unit = 0.001;
  for (const char* name : {"a.pcd", "b.ply", "c.xyz", "d.csv", "e.vtk"}) {
    INFO(name);
    write(folder / name, cloud, CloudFormat::automatic, 0.001);
    CHECK(read_file(folder / name).positions().isApprox(cloud.positions() * 1000.0F, 1e-6F));
    CHECK(read_file(folder / name, millimetres).positions().isApprox(cloud.positions(), 1e-6F));
  }
}

TEST_CASE("left-handed files are turned, with normals and sensors") {
  ReadOptions options;
  options.left_handed = true;
  options.unit = 0.01;
  const Cloud cloud = read(
      "# velum sensor 100 200 300 1 0 0 0 scanner\n# x y z nx ny nz\n"
      "100 200 300 1 0 0\n",
      "scan.3d", options);
  CHECK(cloud.positions().col(0) == Eigen::Vector3f(3, -1, 2));
  CHECK(cloud.normals().col(0) == Eigen::Vector3f(0, -1, 0));
  CHECK(cloud.sensors().at(0).pose.translation().isApprox(Eigen::Vector3d(3, -1, 2)));
}

TEST_CASE("the content decides before the extension") {
  const test::Folder folder;
  write(folder / "cloud.txt", test::plain_cloud(10), CloudFormat::ply);
  CHECK(read_file(folder / "cloud.txt").size() == 10);
  CHECK_THAT(test::error_of("1 2 3\n4 5 6\n", "cloud.pcd"),
             Contains("does not begin as a PCD file"));
  CHECK_THAT(test::error_of(std::string("\1\2\3\4\5\6\7\0", 8), "cloud.txt"),
             Contains("binary data"));
  CHECK_THAT(test::error_of("", "cloud.ply"), Contains("the file is empty"));
  CHECK_THAT(test::error_of("{\"a\": 1}", "cloud.txt"), Contains("a JSON file"));
}

TEST_CASE("an unknown extension is refused before anything is written") {
  const test::Folder folder;
  CHECK_THROWS_AS(write(folder / "cloud.las", test::plain_cloud(3)), Error);
  CHECK_FALSE(std::filesystem::exists(folder / "cloud.las"));
}

TEST_CASE("one and two threads read and write the same bytes") {
  const test::Folder folder;
  const Cloud cloud = test::full_cloud(200000);
  for (const Case& one : {kTyped[0], kTyped[3], kTyped[4]}) {
    std::string content[2];
    std::string hash[2];
    for (const int threads : {1, 2}) {
      run::LocalContext context(threads, 1);
      write_cloud(folder / one.name, cloud, one.format, 1.0, context);
      const FileContent file(folder / one.name);
      content[threads - 1] = file.text();
      Source source(folder / one.name);
      hash[threads - 1] = hash_of(Value(read_cloud(source, {}, context)));
    }
    CHECK(content[0] == content[1]);
    CHECK(hash[0] == hash[1]);
  }
}
