// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "velum/values.hpp"

#include "files/hasher.hpp"

namespace velum {
namespace {

using files::Hasher;

template <class Derived>
void add(Hasher& hasher, const Eigen::MatrixBase<Derived>& matrix) {
  hasher.add(std::int64_t{matrix.rows()});
  hasher.add(std::int64_t{matrix.cols()});
  for (Index j = 0; j < matrix.cols(); ++j)
    for (Index i = 0; i < matrix.rows(); ++i) hasher.add(matrix(i, j));
}

void add(Hasher& hasher, const Column& column) {
  hasher.add(column.scalar());
  hasher.add(std::int64_t{column.width()});
  hasher.add(std::int64_t{column.count()});
  hasher.add(column.bytes());
}

void add(Hasher& hasher, const std::vector<Sensor>& sensors) {
  hasher.add(std::uint64_t{sensors.size()});
  for (const Sensor& sensor : sensors) {
    hasher.add(sensor.name);
    add(hasher, sensor.pose.matrix());
  }
}

void add(Hasher& hasher, const Cloud& cloud) {
  add(hasher, cloud.position_column());
  add(hasher, cloud.origin());
  add(hasher, cloud.sensors());
  hasher.add(std::uint64_t{cloud.columns().size()});
  for (const auto& [name, column] : cloud.columns()) {
    hasher.add(name);
    add(hasher, column);
  }
}

void add(Hasher& hasher, const Mesh& mesh) {
  add(hasher, mesh.vertices());
  add(hasher, mesh.triangle_column());
}

void add(Hasher& hasher, const Surface& surface) {
  hasher.add(std::int64_t{surface.degree_u});
  hasher.add(std::int64_t{surface.degree_v});
  add(hasher, surface.knots_u);
  add(hasher, surface.knots_v);
  add(hasher, surface.control);
  add(hasher, surface.weights);
  hasher.add(std::uint64_t{surface.trimming.size()});
  for (const auto& loop : surface.trimming) add(hasher, loop);
  add(hasher, surface.origin);
  add(hasher, surface.sensors);
}

void add(Hasher& hasher, const Table& table) {
  hasher.add(std::uint64_t{table.headings().size()});
  for (const auto& heading : table.headings()) {
    hasher.add(heading.name);
    hasher.add(heading.unit);
  }
  hasher.add(std::uint64_t{table.size()});
  for (const auto& row : table.rows())
    for (const Cell& cell : row) {
      hasher.add(static_cast<std::uint8_t>(cell.index()));
      std::visit(
          [&](const auto& content) {
            if constexpr (std::is_same_v<std::decay_t<decltype(content)>, std::string>)
              hasher.add(std::string_view(content));
            else
              hasher.add(content);
          },
          cell);
    }
}

void add(Hasher& hasher, const Transform& transform) {
  add(hasher, transform.matrix.matrix());
  hasher.add(transform.source);
  hasher.add(transform.target);
  hasher.add(transform.fitness);
  add(hasher, transform.history);
}

void add(Hasher& hasher, const Clusters& clusters) {
  add(hasher, clusters.cloud);
  add(hasher, clusters.labels);
  add(hasher, clusters.kinds);
}

void add(Hasher& hasher, const Correspondences& pairs) {
  add(hasher, pairs.source);
  add(hasher, pairs.target);
  add(hasher, pairs.distance);
}

struct IsEmpty {
  bool operator()(const Cloud& cloud) const { return cloud.empty(); }
  bool operator()(const Mesh& mesh) const { return mesh.empty(); }
  bool operator()(const Surface& surface) const { return surface.control.cols() == 0; }
  bool operator()(const Transform&) const { return false; }
  bool operator()(const Clusters& clusters) const { return clusters.kinds.empty(); }
  bool operator()(const Correspondences& pairs) const { return pairs.source.count() == 0; }
  bool operator()(const Table&) const { return false; }
};

}  // namespace

bool is_empty(const Value& value) {
  return std::visit(IsEmpty(), value);
}

std::string hash_of(const Value& value) {
  Hasher hasher;
  hasher.add(type_of(value));
  std::visit([&](const auto& content) { add(hasher, content); }, value);
  return hasher.hex();
}

}  // namespace velum
