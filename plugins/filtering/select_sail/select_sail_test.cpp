// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <velum/testing.hpp>

using velum::Cloud;
using velum::Clusters;
using velum::Index;
using velum::Points;
using velum::Table;
using velum::test::Outcome;
using velum::test::Stage;

namespace {

// Both scans of a scene in the frame of the first scanner, cut into smooth regions: walls, floor,
// hull and mast included.
Clusters parts(const std::string& scene, const std::string& first, const std::string& second,
               const std::string& min_size) {
  const std::string file =
      "\"" + std::string(VELUM_SOURCE_DIR) + "/graphs/scenes/" + scene + ".toml\"";
  const auto scan = [&](const std::string& scanner) {
    return Stage("devices.simulator")
        .set("scene", file)
        .set("scanner", "\"" + scanner + "\"")
        .run()
        .cloud();
  };
  const auto pose = Stage("devices.truth")
                        .set("scene", file)
                        .set("scanner", "\"" + second + "\"")
                        .set("frame", "\"" + first + "\"")
                        .run()
                        .get<velum::Transform>();
  const Cloud moved = Stage("filtering.transform").run(scan(second), pose).cloud();
  const Cloud all = Stage("filtering.merge").in_many({scan(first), moved}).run().cloud();
  const Cloud normals = Stage("features.normals").set("neighbours", "30").run(all).cloud();
  return Stage("segmentation.region_growing")
      .set("neighbours", "15")
      .set("smoothness", "7 deg")
      .set("min_size", min_size)
      .run(normals)
      .get<Clusters>();
}

// Share of the points that have the label, and of the label's points that are there.
std::pair<double, double> found(const Cloud& sail, const Cloud& scene, int label) {
  const auto right = static_cast<double>((sail.labels().array() == label).count());
  const auto all = static_cast<double>((scene.labels().array() == label).count());
  return {sail.empty() ? 0.0 : right / static_cast<double>(sail.size()), right / all};
}

void check_sails(const Clusters& clusters, const std::vector<int>& labels) {
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const Outcome outcome =
        Stage("filtering.select_sail").set("index", static_cast<double>(k)).run(clusters);
    const Table& table = outcome.get<Table>();
    for (std::size_t row = 0; row < table.size(); ++row)
      UNSCOPED_INFO(table.number(row, "cluster")
                    << ": " << table.number(row, "points") << " points, score "
                    << table.number(row, "score") << ", "
                    << std::get<std::string>(table.at(row, "reason")));
    CHECK(outcome.measure("sails") == static_cast<double>(labels.size()));
    const auto [precision, recall] = found(outcome.cloud(), clusters.cloud, labels[k]);
    CHECK(precision > 0.98);
    CHECK(recall > 0.9);
  }
}

// A made-up scene of sheets, one cluster each.
class Made {
 public:
  // A sheet over the unit square: u across, v up, placed by `place`.
  template <class Place>
  Made& sheet(const Place& place, int side = 40) {
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j)
        points_.push_back(place((i + 0.5) / side, (j + 0.5) / side).template cast<float>());
    sizes_.push_back(side * side);
    return *this;
  }
  [[nodiscard]] Clusters clusters(const Eigen::Vector3d& origin = {0, 0, 0}) const {
    Points points(3, static_cast<Index>(points_.size()));
    Eigen::VectorXi labels(points.cols());
    Table kinds({{"cluster", ""}, {"points", ""}});
    Index at = 0;
    for (std::size_t c = 0; c < sizes_.size(); ++c) {
      kinds.add({static_cast<std::int64_t>(c), std::int64_t{sizes_[c]}});
      for (int i = 0; i < sizes_[c]; ++i, ++at) {
        points.col(at) = points_[static_cast<std::size_t>(at)];
        labels[at] = static_cast<int>(c);
      }
    }
    return {Cloud(std::move(points), origin).with_sensors({velum::Sensor{}}), velum::Column(labels),
            kinds};
  }

 private:
  std::vector<Eigen::Vector3f> points_;
  std::vector<int> sizes_;
};

// A triangle 3 m high with 10 % camber; `size` scales it.
auto sail(double x, double size = 1.0) {
  return [=](double u, double v) {
    const double chord = 1.5 * (1.0 - 0.95 * v);
    return Eigen::Vector3d(x + size * 4.0 * 0.1 * chord * u * (1.0 - u), size * chord * u,
                           size * 3.0 * v);
  };
}
Eigen::Vector3d wall(double u, double v) {
  return {9.0, 6.0 * u, 8.0 * v};
}
Eigen::Vector3d floor_sheet(double u, double v) {
  return {5.0 * u, 8.0 * v, -1.0 + 0.2 * std::sin(3.0 * u)};
}
Eigen::Vector3d mast(double u, double v) {
  return {0.05 * std::cos(3.0 * u), 0.05 * std::sin(3.0 * u), 6.0 * v};
}
Eigen::Vector3d hull(double u, double v) {
  return {2.0 * (v - 0.5), 0.4 * std::cos(3.0 * u), -0.4 * std::sin(3.0 * u)};
}

std::string reason(const Outcome& outcome, std::size_t row) {
  return std::get<std::string>(outcome.get<Table>().at(row, "reason"));
}

}  // namespace

TEST_CASE("gennaker and mainsail are the sails of the wind tunnel") {
  check_sails(parts("wind_tunnel", "gennaker", "mainsail", "500"), {11, 10});
}

TEST_CASE("mainsail and jib are the sails on the water") {
  check_sails(parts("on_field", "mast", "winch", "500"), {10, 11});
}

TEST_CASE("walls, floors, masts and hulls are no sails, and the table says why") {
  const Clusters scene =
      Made().sheet(wall).sheet(floor_sheet).sheet(mast).sheet(hull).sheet(sail(2)).clusters();
  const Outcome outcome = Stage("filtering.select_sail").run(scene);
  CHECK(outcome.measure("sails") == 1.0);
  CHECK(outcome.measure("candidates") == 5.0);
  REQUIRE(outcome.cloud().size() == 1600);
  CHECK(outcome.cloud().positions()(0, 0) >= 2.0F);
  CHECK(reason(outcome, 0).find("plane") == 0);
  CHECK(reason(outcome, 1).find("lies flat") == 0);
  CHECK(reason(outcome, 2).find("thin") == 0);
  CHECK(outcome.get<Table>().number(3, "score") < 0.5);
  CHECK(outcome.get<Table>().number(4, "sail") == 0.0);
}

TEST_CASE("the figures of a known sail") {
  const Table table =
      Stage("filtering.select_sail").run(Made().sheet(sail(0)).clusters()).get<Table>();
  CHECK(table.number(0, "height") == Approx(3.0).epsilon(0.05));
  CHECK(table.number(0, "width") == Approx(1.5).epsilon(0.05));
  // A trapezium 3 m high with sides of 1.5 and 0.075 m.
  CHECK(table.number(0, "area") == Approx(2.36).epsilon(0.08));
  CHECK(table.number(0, "roughness") < 0.004);
  CHECK(table.number(0, "score") > 0.5);
  CHECK(std::get<std::string>(table.at(0, "reason")).find("upright, smooth") == 0);
}

TEST_CASE("sails are numbered from the largest") {
  const Clusters two = Made().sheet(sail(0, 0.7)).sheet(sail(4)).clusters();
  CHECK(Stage("filtering.select_sail").run(two).cloud().positions()(0, 0) >= 4.0F);
  CHECK(Stage("filtering.select_sail").set("index", "1").run(two).cloud().positions()(0, 0) < 1.0F);
}

TEST_CASE("a scrap beside a sail is none") {
  const Clusters two = Made().sheet(sail(0, 0.2)).sheet(sail(4)).clusters();
  const Outcome outcome = Stage("filtering.select_sail").run(two);
  CHECK(outcome.measure("sails") == 1.0);
  CHECK(reason(outcome, 0).find("small beside") == 0);
  CHECK(Stage("filtering.select_sail").set("share", "0.01").run(two).measure("sails") == 2.0);
}

TEST_CASE("a hint chooses") {
  const Clusters two = Made().sheet(sail(0, 0.7)).sheet(sail(40)).clusters({1e5, 0, 0});
  const Outcome outcome =
      Stage("filtering.select_sail").set("near", "[100000, 0.5, 1]").set("within", "2").run(two);
  CHECK(outcome.measure("sails") == 1.0);
  CHECK(outcome.cloud().positions()(0, 0) < 1.0F);
  CHECK(reason(outcome, 1).find("far") == 0);
}

TEST_CASE("what is up may be said") {
  const auto lying = [](double u, double v) {
    const Eigen::Vector3d p = sail(0)(u, v);
    return Eigen::Vector3d(p.z(), p.x(), p.y());
  };
  const Clusters one = Made().sheet(lying).clusters();
  CHECK(Stage("filtering.select_sail").run(one).measure("sails") == 0.0);
  CHECK(Stage("filtering.select_sail").set("up", "[2, 0, 0]").run(one).measure("sails") == 1.0);
  CHECK_THROWS_AS(Stage("filtering.select_sail").set("up", "[0, 0, 0]").run(one), velum::Error);
}

TEST_CASE("sizes may be asked for") {
  const Clusters one = Made().sheet(sail(0)).clusters();
  CHECK(Stage("filtering.select_sail").set("min_area", "10").run(one).measure("sails") == 0.0);
  CHECK(Stage("filtering.select_sail").set("max_area", "1").run(one).measure("sails") == 0.0);
  CHECK(Stage("filtering.select_sail").set("min_points", "2000").run(one).measure("sails") == 0.0);
  CHECK(Stage("filtering.select_sail").set("min_aspect", "5").run(one).measure("sails") == 0.0);
}

TEST_CASE("no sail gives an empty cloud with a warning, a missing one is an error") {
  const Clusters walls = Made().sheet(wall).clusters();
  const Outcome outcome = Stage("filtering.select_sail").run(walls);
  CHECK(outcome.cloud().empty());
  CHECK(outcome.warnings.size() == 1);
  CHECK_THROWS_AS(Stage("filtering.select_sail").set("index", "1").run(walls), velum::Error);
  CHECK_THROWS_AS(Stage("filtering.select_sail").set("index", "-1"), velum::Error);
}

TEST_CASE("conformance") {
  for (const auto& fault : velum::test::conformance("filtering.select_sail")) FAIL_CHECK(fault);
}
