// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <regex>

#include "formats/detect.hpp"
#include "formats/test_tools.hpp"

// A walk over real data that lie beside the checkout, where they do.

using namespace velum;
using namespace velum::formats;
namespace fs = std::filesystem;

namespace {

std::optional<fs::path> shared_data() {
  const char* shared = std::getenv("VELUM_SHARED");
  if (shared == nullptr || !fs::exists(fs::path(shared) / "data/ORIGIN.md")) return std::nullopt;
  return fs::path(shared) / "data";
}

/// What the list of the data says of one file.
struct Listed {
  fs::path path;
  Index points = 0;
  Index finite = 0;
  std::optional<Index> faces;
};

/// The rows "| file | MB | points | ..." with a count.
std::vector<Listed> list_of(const fs::path& data) {
  const std::regex row(
      R"(\| ([^ |]+) \| [0-9.]+ \| (\d+)(?: \((\d+) finite\))?(?:, (\d+) faces)? \|.*)");
  std::ifstream file(data / "ORIGIN.md");
  std::vector<Listed> list;
  std::smatch parts;
  for (std::string line; std::getline(file, line);) {
    if (!std::regex_match(line, parts, row)) continue;
    Listed one{data / parts[1].str(), std::stoll(parts[2]), std::stoll(parts[2]), {}};
    if (parts[3].matched) one.finite = std::stoll(parts[3]);
    if (parts[4].matched) one.faces = std::stoll(parts[4]);
    list.push_back(std::move(one));
  }
  return list;
}

}  // namespace

TEST_CASE("every listed cloud and mesh loads with its count") {
  const auto data = shared_data();
  if (!data) {
    WARN("skipped: no shared data");
    return;
  }
  const std::vector<Listed> list = list_of(*data);
  CHECK(list.size() >= 35);
  for (const Listed& one : list) {
    INFO(one.path);
    ReadOptions options;
    if (one.path.extension() == ".3d") {
      options.unit = 0.01;
      options.left_handed = true;
    }
    run::LocalContext context(2, 1);
    Source source(one.path);
    const Cloud cloud = read_cloud(source, options, context);
    CHECK(cloud.size() == one.finite);
    CHECK(context.measures().at("dropped").value == static_cast<double>(one.points - one.finite));
    if (one.faces) CHECK(test::read_mesh_file(one.path).size() == *one.faces);
  }
}

TEST_CASE("malformed and tricky files are read right or refused cleanly") {
  const auto data = shared_data();
  if (!data) {
    WARN("skipped: no shared data");
    return;
  }
  int seen = 0;
  for (const auto& entry : fs::recursive_directory_iterator(*data / "malformed")) {
    if (!entry.is_regular_file()) continue;
    ++seen;
    INFO(entry.path());
    for (const bool as_mesh : {false, true}) {
      try {
        if (as_mesh)
          (void)test::read_mesh_file(entry.path());
        else
          (void)test::read_file(entry.path());
      } catch (const Error& error) {
        CHECK(error.fault() == Fault::input);
        CHECK_THAT(error.where(), Catch::StartsWith(entry.path().string()));
      }
    }
  }
  CHECK(seen >= 55);
}

TEST_CASE("the variants of one mesh are the same") {
  const auto data = shared_data();
  if (!data) {
    WARN("skipped: no shared data");
    return;
  }
  const fs::path folder = *data / "malformed/happly";
  const Mesh little = test::read_mesh_file(folder / "platonic_shelf.ply");
  for (const char* name : {"platonic_shelf_ascii.ply", "platonic_shelf_big_endian.ply"}) {
    const Mesh other = test::read_mesh_file(folder / name);
    CHECK(other.triangles() == little.triangles());
    CHECK(other.positions().isApprox(little.positions(), 1e-5F));
  }
}

TEST_CASE("the nodding scans stand upright in metres") {
  const auto data = shared_data();
  if (!data) {
    WARN("skipped: no shared data");
    return;
  }
  ReadOptions options;
  options.unit = 0.01;
  options.left_handed = true;
  const Cloud cloud = test::read_file(*data / "registration/sick_nodding/scan000.3d", options);
  // The file's y is the height; no-return beams lie at about 32 m.
  CHECK(bounding_box(cloud.positions()).sizes().maxCoeff() > 20.0F);
  CHECK(bounding_box(cloud.positions()).sizes().maxCoeff() < 80.0F);
}

TEST_CASE("UTM coordinates keep their precision") {
  const auto data = shared_data();
  if (!data) {
    WARN("skipped: no shared data");
    return;
  }
  const Cloud site = test::read_file(*data / "large/CSite1_red1-utm.pcd");
  CHECK(site.origin().y() > 5e6);
  CHECK(site.positions().row(1).cwiseAbs().maxCoeff() < 5000.0F);
  const Cloud ground = test::read_file(*data / "malformed/pdal/text__utm17_1.txt");
  const Eigen::Vector3d first = ground.origin() + ground.positions().col(0).cast<double>();
  CHECK((first - Eigen::Vector3d(289814.15, 4320978.61, 170.76)).cwiseAbs().maxCoeff() < 1e-5);
  const Cloud las = test::read_file(*data / "las/autzen_trim.las");
  const Eigen::Matrix3Xd places = las.positions().cast<double>().colwise() + las.origin();
  double worst = 0.0;
  for (Index i = 0; i < places.cols(); ++i)
    worst = std::max(worst, std::abs(std::remainder(places(0, i), 0.01)));
  CHECK(worst < 1e-3);
}
