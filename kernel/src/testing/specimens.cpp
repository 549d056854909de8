// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "testing/specimens.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "velum/random.hpp"

namespace velum::test {
namespace {

constexpr Index kSide = 24;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Where a point of the sheet lies for (u, v) in [0, 1]².
Eigen::Vector3f on_sheet(float u, float v) {
  return {u, v, 0.3F * u * (1.0F - u) + 0.1F * std::sin(3.0F * v)};
}

Points sheet_points() {
  Points points(3, kSide * kSide);
  for (Index i = 0; i < points.cols(); ++i) {
    // A little off the grid, so that no four points lie on one circle.
    Random random = Random(7).split(static_cast<std::uint64_t>(i));
    const auto at = [&](Index k) {
      return (static_cast<float>(k) + 0.2F * static_cast<float>(random.uniform())) / kSide;
    };
    const float u = at(i % kSide);
    points.col(i) = on_sheet(u, at(i / kSide));
  }
  return points;
}

/// Columns that hold something sensible for any set of points.
Cloud with_columns(const Points& points, const Eigen::Vector3d& origin) {
  const Index n = points.cols();
  Points normals(3, n);
  for (Index i = 0; i < n; ++i) {
    const float u = std::clamp(points(0, i), 0.0F, 1.0F);
    normals.col(i) = Eigen::Vector3f(-0.3F * (1.0F - 2.0F * u), 0.0F, -1.0F).normalized();
  }
  const Eigen::VectorXi number =
      Eigen::VectorXi::LinSpaced(n, 0, static_cast<int>(std::max<Index>(n - 1, 0)));
  const Eigen::VectorXi line = number.unaryExpr([](int i) { return i / static_cast<int>(kSide); });
  const Eigen::VectorXi beam = number.unaryExpr([](int i) { return i % static_cast<int>(kSide); });
  Sensor sensor;
  sensor.name = "scanner";
  sensor.pose.translation() = origin + Eigen::Vector3d(0.5, 0.5, -3.0);
  return Cloud(points, origin)
      .with_sensors({sensor})
      .with(column::kNormals, Column(normals))
      .with(column::kCurvature, Column(Eigen::VectorXf(Eigen::VectorXf::Constant(n, 0.01F))))
      .with(column::kIntensity, Column(Eigen::VectorXf(number.cast<float>())))
      .with(column::kColour, Column::zeros(Scalar::u8, 3, n))
      .with(column::kTime, Column(Eigen::VectorXd(number.cast<double>() * 1e-3)))
      .with(column::kLabel, Column(line.unaryExpr([](int l) { return l % 2; }).eval()))
      .with(column::kSensor, Column::zeros(Scalar::u8, 1, n))
      .with(column::kBeam, Column(beam))
      .with(column::kLine, Column(line))
      .with(column::kTilt, Column(Eigen::VectorXf(line.cast<float>() * 0.01F)));
}

Specimen made(std::string name, const Points& points, Index grid = 0,
              const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  return {std::move(name), with_columns(points, origin), grid};
}

/// The sheet with every tenth entry of its real columns NaN, every eleventh infinite.
Specimen spoiled_columns() {
  Specimen specimen = sheet();
  const Cloud& cloud = specimen.cloud;
  Points normals = cloud.normals();
  Eigen::VectorXf curvature = cloud.curvature();
  Eigen::VectorXf intensity = cloud.intensity();
  for (Index i = 0; i < cloud.size(); ++i) {
    if (i % 10 != 0 && i % 11 != 0) continue;
    const float value = i % 10 == 0 ? kNaN : kInfinity;
    normals.col(i).setConstant(value);
    curvature[i] = value;
    intensity[i] = value;
  }
  specimen.name = "numbers in columns that are not finite";
  specimen.cloud = cloud.with(column::kNormals, Column(normals))
                       .with(column::kCurvature, Column(curvature))
                       .with(column::kIntensity, Column(intensity));
  return specimen;
}

Mesh make_mesh(const Specimen& specimen) {
  const Index n = specimen.cloud.size();
  std::vector<Eigen::Vector3i> corners;
  const auto add = [&](Index a, Index b, Index c) {
    corners.emplace_back(static_cast<int>(a), static_cast<int>(b), static_cast<int>(c));
  };
  if (specimen.grid > 1) {
    const Index w = specimen.grid;
    for (Index i = 0; i + w < n; ++i) {
      if (i % w == w - 1) continue;
      add(i, i + 1, i + w);
      add(i + 1, i + w + 1, i + w);
    }
  } else {
    for (Index i = 0; i + 2 < n; ++i) add(i, i + 1, i + 2);
  }
  Triangles triangles(3, static_cast<Index>(corners.size()));
  for (std::size_t i = 0; i < corners.size(); ++i)
    triangles.col(static_cast<Index>(i)) = corners[i];
  return {specimen.cloud, triangles};
}

/// Two clusters, the first half and the second; as many as there are points for.
Clusters make_clusters(const Specimen& specimen) {
  const Index n = specimen.cloud.size();
  Clusters clusters;
  clusters.cloud = specimen.cloud;
  Eigen::VectorXi labels = Eigen::VectorXi::Zero(n);
  labels.tail(n / 2).setOnes();
  clusters.labels = Column(labels);
  clusters.kinds = Table({{"cluster", ""}, {"points", ""}});
  for (std::int64_t k = 0; k < std::min<Index>(n, 2); ++k)
    clusters.kinds.add(
        {k, static_cast<std::int64_t>((labels.array() == static_cast<int>(k)).count())});
  return clusters;
}

/// A bicubic patch over control points taken from the specimen, or all in one place.
Surface make_surface(const Specimen& specimen) {
  Surface surface;
  surface.knots_u.resize(8);
  surface.knots_u << 0, 0, 0, 0, 1, 1, 1, 1;
  surface.knots_v = surface.knots_u;
  surface.control.setZero(3, 16);
  const Cloud& cloud = specimen.cloud;
  for (Index i = 0; i < 16 && !cloud.empty(); ++i) {
    const Index row = i / 4 * (kSide - 1) / 3;
    const Index point = specimen.grid > 0 ? row + i % 4 * (kSide - 1) / 3 * specimen.grid : i;
    surface.control.col(i) =
        cloud.positions().col(std::min(point, cloud.size() - 1)).cast<double>();
  }
  surface.origin = cloud.origin();
  surface.sensors = cloud.sensors();
  return surface;
}

Correspondences make_pairs(const Specimen& specimen) {
  const auto n = specimen.cloud.size();
  Correspondences pairs;
  const Eigen::VectorXi number =
      Eigen::VectorXi::LinSpaced(n, 0, static_cast<int>(std::max<Index>(n - 1, 0)));
  pairs.source = Column(number);
  pairs.target = Column(number);
  pairs.distance = Column(Eigen::VectorXf(Eigen::VectorXf::Zero(n)));
  return pairs;
}

Transform make_transform() {
  Transform transform;
  transform.matrix = Eigen::Translation3d(0.01, -0.02, 0.03) *
                     Eigen::AngleAxisd(0.02, Eigen::Vector3d(1.0, 2.0, 3.0).normalized());
  return transform;
}

Table make_table(const Specimen& specimen) {
  Table table({{"index", ""}, {"x", "m"}});
  for (Index i = 0; i < std::min<Index>(specimen.cloud.size(), 10); ++i)
    table.add({std::int64_t{i}, static_cast<double>(specimen.cloud.positions()(0, i))});
  return table;
}

Cloud fitted(const Port& port, Cloud cloud, bool spare) {
  std::set<std::string> named;
  for (const ColumnRule& rule : port.columns) {
    named.insert(rule.column);
    // Columns without a meaning of their own: a histogram's worth of ones.
    if (!cloud.has(rule.column))
      cloud =
          cloud.with(rule.column, Column(Eigen::MatrixXf(Eigen::MatrixXf::Ones(33, cloud.size()))));
  }
  if (!spare) return cloud;
  const Columns columns = cloud.columns();
  for (const auto& [name, column] : columns)
    if (!named.contains(name)) cloud = cloud.without(name);
  return cloud;
}

}  // namespace

Specimen sheet() {
  return made("a curved sheet", sheet_points(), kSide);
}

std::vector<Specimen> degenerate_specimens() {
  const Points points = sheet_points();
  std::vector<Specimen> all;
  for (const Index n : {0, 1, 2, 3})
    all.push_back(made(std::to_string(n) + (n == 1 ? " point" : " points"), points.leftCols(n)));
  all.push_back(made("50 equal points", points.col(5).replicate(1, 50)));
  Points flat = points;
  flat.row(2).setZero();
  Points line = flat.leftCols(100);
  line.row(1).setZero();
  line.row(0) = Eigen::RowVectorXf::LinSpaced(100, 0.0F, 1.0F);
  all.push_back(made("100 points on a line", line));
  all.push_back(made("points in a plane", flat, kSide));
  all.push_back(made("points 1e7 m away", points, kSide, Eigen::Vector3d(1e7, -1e7, 1e7)));
  all.push_back(made("points scaled by 1e-6", points * 1e-6F, kSide));
  all.push_back(spoiled_columns());
  return all;
}

Value make_value(ValueType type, const Specimen& specimen) {
  switch (type) {
    case ValueType::cloud:
      return specimen.cloud;
    case ValueType::mesh:
      return make_mesh(specimen);
    case ValueType::surface:
      return make_surface(specimen);
    case ValueType::transform:
      return make_transform();
    case ValueType::clusters:
      return make_clusters(specimen);
    case ValueType::correspondences:
      return make_pairs(specimen);
    case ValueType::table:
      return make_table(specimen);
  }
  throw Error(Fault::stage, "a value of unknown type");
}

Value fit_to(const Port& port, const Value& value, bool spare) {
  if (const auto* cloud = std::get_if<Cloud>(&value)) return fitted(port, *cloud, spare);
  if (const auto* mesh = std::get_if<Mesh>(&value))
    return mesh->with_vertices(fitted(port, mesh->vertices(), spare));
  if (const auto* clusters = std::get_if<Clusters>(&value)) {
    Clusters fit = *clusters;
    fit.cloud = fitted(port, fit.cloud, spare);
    return fit;
  }
  return value;
}

}  // namespace velum::test
