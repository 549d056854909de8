// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "report/quantise.hpp"
#include "report/surface_mesh.hpp"
#include "report/views.hpp"
#include "velum/random.hpp"

using namespace velum;
using report::View;
using report::Views;

namespace {

Points scattered(Index count, float size, std::uint64_t seed = 1) {
  Random random(seed);
  Points points(3, count);
  for (Index i = 0; i < points.size(); ++i)
    points.data()[i] = size * static_cast<float>(random.uniform());
  return points;
}

View view_of(const Value& value, const std::string& node, std::size_t order = 0) {
  View view = report::make_view(value);
  view.node = node;
  view.output = "cloud";
  view.order = order;
  return view;
}

Eigen::Vector3d position(const View& view, std::size_t i) {
  const auto steps = view.positions.as<std::uint16_t>();
  Eigen::Vector3d p;
  for (int axis = 0; axis < 3; ++axis)
    p[axis] = view.lo[axis] + steps[3 * i + static_cast<std::size_t>(axis)] / 65535.0 *
                                  (view.hi[axis] - view.lo[axis]);
  return view.origin + p;
}

const report::ViewColumn& column_of(const View& view, const std::string& name) {
  for (const auto& column : view.columns)
    if (column.name == name) return column;
  throw std::runtime_error("no column " + name);
}

/// A square of n by n vertices with two triangles a field.
Mesh square(int n) {
  Points points(3, n * n);
  Triangles triangles(3, 2 * (n - 1) * (n - 1));
  Index t = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      points.col(i * n + j) = Eigen::Vector3f(static_cast<float>(i), static_cast<float>(j), 0.0F);
      if (i + 1 == n || j + 1 == n) continue;
      const int a = i * n + j;
      triangles.col(t++) << a, a + n, a + n + 1;
      triangles.col(t++) << a, a + n + 1, a + 1;
    }
  return {Cloud(points), triangles};
}

}  // namespace

TEST_CASE("positions are off by at most half a step, at any origin") {
  for (const double origin : {0.0, 5.0e6}) {
    const Cloud cloud(scattered(1000, 20.0F), Eigen::Vector3d(origin, -origin, 100.0));
    const View view = report::make_view(cloud);
    REQUIRE(view.shown == 1000);
    REQUIRE(view.origin == cloud.origin());
    const Eigen::Vector3d half = 0.5 * (view.hi - view.lo) / 65535.0;
    for (std::size_t i = 0; i < 1000; ++i) {
      const Eigen::Vector3d exact =
          cloud.origin() + cloud.positions().col(static_cast<Index>(i)).cast<double>();
      const Eigen::Vector3d off = (position(view, i) - exact).cwiseAbs();
      // Doubles at 5e6 m have 1 nm.
      REQUIRE(((half.array() + 2e-9 - off.array()) >= 0.0).all());
    }
  }
}

TEST_CASE("a flat cloud, one point and none have positions") {
  Points flat = scattered(50, 1.0F);
  flat.row(2).setConstant(3.0F);
  const View view = report::make_view(Cloud(flat));
  CHECK(position(view, 7).z() == 3.0);
  const View one = report::make_view(Cloud(Points(Eigen::Vector3f(1.0F, 2.0F, 3.0F))));
  CHECK(position(one, 0) == Eigen::Vector3d(1.0, 2.0, 3.0));
  const View none = report::make_view(Cloud());
  CHECK(none.shown == 0);
  CHECK(none.positions.there());
  CHECK(none.positions.size() == 0);
}

TEST_CASE("numbers keep their range, and what is no number stays none") {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  Eigen::VectorXf numbers(5);
  numbers << 0.25F, kNan, -1.0F, kInf, 3.0F;
  const Cloud cloud =
      Cloud(scattered(5, 1.0F))
          .with("displacement", Column(numbers))
          .with("empty", Column(Eigen::VectorXf(Eigen::VectorXf::Constant(5, kNan))));
  const View view = report::make_view(cloud);
  const auto& column = column_of(view, "displacement");
  const auto steps = column.data.as<std::uint16_t>();
  CHECK(column.unit == "m");
  CHECK(column.lo == -1.0);
  CHECK(column.hi == 3.0);
  CHECK(steps[1] == report::kNoNumber);
  CHECK(steps[3] == report::kNoNumber);
  CHECK(steps[2] == 0);
  CHECK(steps[4] == 65534);
  CHECK(std::abs(column.lo + steps[0] / 65534.0 * 4.0 - 0.25) <= 2.0 / 65534.0);
  for (const std::uint16_t step : column_of(view, "empty").data.as<std::uint16_t>())
    CHECK(step == report::kNoNumber);
}

TEST_CASE("the largest doubles do not overflow a column") {
  Eigen::VectorXd numbers(3);
  numbers << -1.7e308, 0.0, 1.7e308;
  const auto column = report::quantise("x", Column(numbers));
  REQUIRE(column);
  CHECK(column->data.as<std::uint16_t>()[0] == 0);
  CHECK(column->data.as<std::uint16_t>()[1] == 32767);
  CHECK(column->data.as<std::uint16_t>()[2] == 65534);
}

TEST_CASE("labels are kept as they are, negative ones as none") {
  Eigen::VectorXi label(3);
  label << 7, -1, 65534;
  const auto narrow = report::quantise("label", Column(label));
  REQUIRE(narrow);
  CHECK(narrow->bits == 16);
  CHECK(narrow->data.as<std::uint16_t>()[0] == 7);
  CHECK(narrow->data.as<std::uint16_t>()[1] == 65535);
  CHECK(narrow->data.as<std::uint16_t>()[2] == 65534);
  label[2] = 65535;
  const auto wide = report::quantise("label", Column(label));
  REQUIRE(wide);
  CHECK(wide->bits == 32);
  CHECK(wide->data.as<std::uint32_t>()[1] == 0xFFFFFFFFU);
  CHECK(wide->data.as<std::uint32_t>()[2] == 65535U);
}

TEST_CASE("sensors are labels with the sensors' names; bookkeeping and wide columns are left out") {
  VectorXu8 sensor(2);
  sensor << 0, 255;
  const Cloud cloud =
      Cloud(scattered(2, 1.0F))
          .with(column::kSensor, Column(sensor))
          .with(column::kBeam, Column(Eigen::VectorXi(Eigen::VectorXi::Zero(2))))
          .with(column::kNormals, Column(Points(Points::Ones(3, 2))))
          .with_sensors({Sensor{"north", Pose(Eigen::Translation3d(1.0, 2.0, 3.0))}});
  const View view = report::make_view(cloud);
  REQUIRE(view.columns.size() == 1);
  CHECK(view.columns[0].names == std::vector<std::string>{"north"});
  CHECK(view.columns[0].data.as<std::uint16_t>()[1] == 65535);
  REQUIRE(view.sensors.size() == 1);
}

TEST_CASE("clusters are a cloud with the column cluster and the rows of their table") {
  Clusters clusters;
  clusters.cloud = Cloud(scattered(3, 1.0F));
  Eigen::VectorXi label(3);
  label << 0, 1, -1;
  clusters.labels = Column(label);
  clusters.kinds = Table({{"cluster", ""}, {"points", ""}});
  clusters.kinds.add({std::int64_t{0}, std::int64_t{1}});
  const View view = report::make_view(clusters);
  CHECK(view.columns.at(0).name == "cluster");
  CHECK(view.rows.at("rows").at(0).at(1) == 1);
}

TEST_CASE("long tables are thinned, and numbers that are none are null") {
  Table table({{"x", "m"}, {"name", ""}});
  for (int i = 0; i < 12000; ++i)
    table.add({i == 0 ? std::nan("") : static_cast<double>(i), std::string("a")});
  const View view = report::make_view(table);
  CHECK(view.count == 12000);
  CHECK(view.shown == report::kMostRows);
  CHECK(view.rows.at("rows").size() == report::kMostRows);
  CHECK(view.rows.at("rows").at(0).at(0).is_null());
  CHECK(view.rows.at("rows").back().at(0).get<double>() > 11990.0);
}

TEST_CASE("many tables are thinned together, the longest first") {
  std::vector<View> views;
  for (const int rows : {4000, 10, 1000}) {
    Table table({{"x", "m"}, {"y", "m"}});
    for (int i = 0; i < rows; ++i) table.add({static_cast<double>(i), 0.0});
    views.push_back(view_of(table, "t" + std::to_string(rows)));
  }
  report::limit_tables(views, 3000);
  CHECK(views[0].shown == 500);
  CHECK(views[0].count == 4000);
  CHECK(views[0].rows.at("rows").at(1).at(0) == 8.0);
  CHECK(views[1].shown == 10);
  CHECK(views[2].shown == 500);
}

TEST_CASE("a cloud is thinned evenly, a mesh by merging its vertices") {
  const auto half = report::thinner(view_of(Cloud(scattered(1000, 1.0F)), "a"));
  REQUIRE(half);
  CHECK(half->shown == 500);
  CHECK(half->count == 1000);
  const View whole = view_of(square(40), "m");
  const auto less = report::thinner(whole);
  REQUIRE(less);
  CHECK(less->shown <= 960);
  CHECK(less->shown > 100);
  const auto indices = report::indices_of(*less);
  REQUIRE(indices.size() % 3 == 0);
  double area = 0.0;
  for (std::size_t t = 0; t < indices.size(); t += 3) {
    const Eigen::Vector3d a = position(*less, indices[t]);
    const Eigen::Vector3d normal =
        (position(*less, indices[t + 1]) - a).cross(position(*less, indices[t + 2]) - a);
    CHECK(normal.z() >= 0.0);  // as before
    area += 0.5 * normal.norm();
  }
  CHECK(area > 0.9 * 39.0 * 39.0);
  CHECK(area < 1.001 * 39.0 * 39.0);
}

TEST_CASE("equal positions are stored once, and stay shared when thinned") {
  const Cloud cloud(scattered(2000, 1.0F));
  const Cloud coloured =
      cloud.with("x", Column(Eigen::VectorXf(Eigen::VectorXf::LinSpaced(2000, 0.0F, 1.0F))));
  Views views(1'000'000);
  views.add(view_of(cloud, "a", 0));
  views.add(view_of(coloured, "b", 1));
  CHECK(views.bytes() == 2000 * 6 + 2000 * 2);
  views.limit_to(9000);
  CHECK(views.bytes() == 1000 * 6 + 1000 * 2);
  const report::Packed packed = report::pack(views.all());
  CHECK(packed.values.at(0).at("positions").at("at") ==
        packed.values.at(1).at("positions").at("at"));
  CHECK(packed.values.at(0).at("shown") == 1000);
  CHECK(packed.block.size() == 8000);
}

TEST_CASE("what is kept does not depend on the order in which views come") {
  std::vector<View> some;
  for (std::size_t i = 0; i < 6; ++i) {
    const Cloud cloud(scattered(static_cast<Index>(600 * (i % 3) + 900), 1.0F, i % 3));
    const auto name = static_cast<char>('a' + i);
    Eigen::VectorXf numbers = Eigen::VectorXf::Constant(cloud.size(), static_cast<float>(i));
    some.push_back(view_of(i < 3 ? cloud : cloud.with(std::string(1, name), Column(numbers)),
                           std::string(1, name), i));
  }
  std::vector<std::size_t> order = {0, 1, 2, 3, 4, 5};
  std::vector<std::byte> first;
  do {
    Views views(12'000);
    for (const std::size_t i : order) views.add(some[i]);
    CHECK(views.bytes() <= 12'000);
    const auto block = report::pack(views.all()).block;
    if (first.empty()) first = block;
    REQUIRE(block == first);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("packed views come back as they were") {
  std::vector<View> views = {view_of(square(20), "mesh", 0), view_of(Table({{"x", "m"}}), "t", 1)};
  Transform transform;
  transform.matrix.translation() = Eigen::Vector3d(1.0, 2.0, 3.0);
  views.push_back(view_of(transform, "move", 2));
  const report::Packed packed = report::pack(views);
  const auto again = report::unpack(packed.values, packed.histograms, packed.block);
  const report::Packed repacked = report::pack(again);
  CHECK(repacked.values == packed.values);
  CHECK(repacked.histograms == packed.histograms);
  CHECK(repacked.block == packed.block);
  auto cut = packed.block;
  cut.resize(cut.size() / 2);
  CHECK_THROWS_AS(report::unpack(packed.values, packed.histograms, cut), Error);
}

TEST_CASE("a surface is sampled within its trimming") {
  Surface surface;
  surface.degree_u = surface.degree_v = 1;
  surface.knots_u = surface.knots_v = Eigen::Vector4d(0.0, 0.0, 1.0, 1.0);
  surface.control.resize(3, 4);
  surface.control << 0, 0, 2, 2, 0, 2, 0, 2, 1, 1, 1, 1;
  const auto area_of = [](const Mesh& mesh) {
    double area = 0.0;
    for (Index t = 0; t < mesh.size(); ++t) {
      const Eigen::Vector3f a = mesh.positions().col(mesh.triangles()(0, t));
      const Eigen::Vector3f b = mesh.positions().col(mesh.triangles()(1, t));
      const Eigen::Vector3f c = mesh.positions().col(mesh.triangles()(2, t));
      area += 0.5 * static_cast<double>((b - a).cross(c - a).norm());
    }
    return area;
  };
  CHECK(area_of(report::sampled(surface)) == Approx(4.0));
  Eigen::Matrix2Xd circle(2, 200);
  for (int i = 0; i < 200; ++i)
    circle.col(i) << 0.5 + 0.4 * std::cos(0.0314159265 * i), 0.5 + 0.4 * std::sin(0.0314159265 * i);
  surface.trimming = {circle};
  const Mesh disk = report::sampled(surface);
  CHECK(area_of(disk) == Approx(EIGEN_PI * 0.64).epsilon(0.003));
  for (Index i = 0; i < disk.vertices().size(); ++i)
    CHECK((disk.positions().col(i) - Eigen::Vector3f(1.0F, 1.0F, 1.0F)).norm() < 0.801F);
  surface.knots_u.setConstant(std::nan(""));
  CHECK(report::sampled(surface).empty());
}
