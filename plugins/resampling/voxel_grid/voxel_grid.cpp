// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include <cmath>

namespace {

using velum::Cloud;
using velum::Index;

enum class Representative { mean, nearest };

// A cell's number along each axis, from 0; the extent must fit 2²¹ cells.
constexpr int kBits = 21;
constexpr double kMostCells = 2097152.0;

// The points of one cell: keys[begin, end) of the sorted list.
struct Cell {
  std::size_t begin, end;
};

using Key = std::pair<std::uint64_t, std::int32_t>;

// Cells lie at whole multiples of `size` of true coordinates, so that clouds of one frame share
// them whatever their extent.
class Grid {
 public:
  Grid(const Cloud& cloud, double size) : size_(size) {
    const Eigen::AlignedBox3f box = velum::bounding_box(cloud.positions());
    const Eigen::Array3d low = cloud.origin().array() + box.min().cast<double>().array();
    const Eigen::Array3d high = cloud.origin().array() + box.max().cast<double>().array();
    first_ = (low / size).floor();
    const double cells = ((high / size).floor() - first_).maxCoeff() + 1.0;
    if (!(cells <= kMostCells))
      throw velum::Error(velum::Fault::stage,
                         "the cloud is more than 2,097,152 cells long; the size is too small")
          .hint("use a larger 'size', or remove far points first");
    offset_ = (cloud.origin().array() / size) - first_;
  }
  [[nodiscard]] Eigen::Array3d at(const Eigen::Vector3f& point) const {
    // Rounding may put a point of the box's low side just below cell 0.
    return (point.cast<double>().array() / size_ + offset_).floor().max(0.0).min(kMostCells - 1.0);
  }
  [[nodiscard]] std::uint64_t key(const Eigen::Vector3f& point) const {
    std::uint64_t key = 0;
    for (const double index : at(point)) key = (key << kBits) | static_cast<std::uint64_t>(index);
    return key;
  }
  // Centre of the point's cell, relative to the cloud's origin.
  [[nodiscard]] Eigen::Vector3d centre(const Eigen::Vector3f& point) const {
    return ((at(point) - offset_ + 0.5) * size_).matrix();
  }

 private:
  double size_;
  Eigen::Array3d first_;
  Eigen::Array3d offset_;
};

std::vector<Key> sorted_keys(const Cloud& cloud, const Grid& grid, velum::Context& context) {
  const auto positions = cloud.positions();
  std::vector<Key> keys(static_cast<std::size_t>(cloud.size()));
  velum::parallel_for(context, cloud.size(), 65536, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i)
      keys[static_cast<std::size_t>(i)] = {grid.key(positions.col(i)),
                                           static_cast<std::int32_t>(i)};
  });
  std::sort(keys.begin(), keys.end());
  context.check();
  return keys;
}

std::vector<Cell> cells_of(const std::vector<Key>& keys, int min_points) {
  std::vector<Cell> cells;
  for (std::size_t begin = 0; begin < keys.size();) {
    std::size_t end = begin + 1;
    while (end < keys.size() && keys[end].first == keys[begin].first) ++end;
    if (end - begin >= static_cast<std::size_t>(min_points)) cells.push_back({begin, end});
    begin = end;
  }
  return cells;
}

// What is the same of neighbouring measurements is averaged: numbers with a decimal point, colours
// and normals. Labels, sensors and other counts come from the point nearest to the cell's centre.
bool averaged(const std::string& name, const velum::Column& column) {
  return column.scalar() == velum::Scalar::f32 || column.scalar() == velum::Scalar::f64 ||
         name == velum::column::kColour;
}

template <class T>
velum::Column mean_of(const velum::Column& column, const std::vector<Key>& keys,
                      const std::vector<Cell>& cells) {
  using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  const auto values = column.as<T>();
  Matrix means(values.rows(), static_cast<Index>(cells.size()));
  Eigen::VectorXd sum(values.rows());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    sum.setZero();
    for (std::size_t k = cells[c].begin; k < cells[c].end; ++k)
      sum += values.col(keys[k].second).template cast<double>();
    sum /= static_cast<double>(cells[c].end - cells[c].begin);
    if constexpr (std::is_integral_v<T>) sum = sum.array().round();
    means.col(static_cast<Index>(c)) = sum.template cast<T>();
  }
  return velum::Column(std::move(means));
}

velum::Column mean_of(const velum::Column& column, const std::vector<Key>& keys,
                      const std::vector<Cell>& cells) {
  switch (column.scalar()) {
    case velum::Scalar::f64:
      return mean_of<double>(column, keys, cells);
    case velum::Scalar::u8:
      return mean_of<std::uint8_t>(column, keys, cells);
    default:
      return mean_of<float>(column, keys, cells);
  }
}

// The mean of a cell's normals, turned to the side of `kept`'s; `kept`'s own where they cancel.
velum::Column mean_normals(const Cloud& cloud, const std::vector<Key>& keys,
                           const std::vector<Cell>& cells, const Cloud& kept) {
  velum::Points means(3, kept.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto slot = static_cast<Index>(c);
    const Eigen::Vector3d own = kept.normals().col(slot).cast<double>();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t k = cells[c].begin; k < cells[c].end; ++k) {
      const Eigen::Vector3d n = cloud.normals().col(keys[k].second).cast<double>();
      sum += n.dot(own) < 0.0 ? Eigen::Vector3d(-n) : n;
    }
    means.col(slot) = (sum.norm() > 1e-9 ? sum.normalized() : own).cast<float>();
  }
  return velum::Column(std::move(means));
}

struct VoxelGrid {
  velum::Length size;
  Representative point = Representative::mean;
  int min_points = 1;

  static auto about() {
    return velum::About<VoxelGrid>("One point for each occupied cell of a cubic grid.")
        .in("cloud")
        .out("cloud")
        .param(&VoxelGrid::size, "size", "edge length of a cell", velum::above(0.0))
        .required()
        .choice(&VoxelGrid::point, "point", "what stands for the points of a cell",
                {{"mean", Representative::mean, "their mean, of columns too"},
                 {"nearest", Representative::nearest,
                  "the measured point nearest to the cell's centre, with all its columns"}})
        .param(&VoxelGrid::min_points, "min_points", "cells with fewer points give none",
               velum::at_least(1))
        .deterministic();
  }

  Cloud operator()(const Cloud& cloud, velum::Context& context) const {
    context.check();
    if (cloud.empty()) {
      report(0, 0, context);
      return cloud;
    }
    const Grid grid(cloud, size);
    const auto keys = sorted_keys(cloud, grid, context);
    const auto cells = cells_of(keys, min_points);
    report(cloud.size(), static_cast<Index>(cells.size()), context);
    const Cloud kept = cloud.select(nearest_to_centre(cloud, grid, keys, cells));
    return point == Representative::nearest ? kept : with_means(cloud, keys, cells, kept);
  }

 private:
  static std::vector<std::int32_t> nearest_to_centre(const Cloud& cloud, const Grid& grid,
                                                     const std::vector<Key>& keys,
                                                     const std::vector<Cell>& cells) {
    const auto positions = cloud.positions();
    std::vector<std::int32_t> nearest;
    nearest.reserve(cells.size());
    for (const Cell& cell : cells) {
      const Eigen::Vector3d centre = grid.centre(positions.col(keys[cell.begin].second));
      double least = std::numeric_limits<double>::infinity();
      std::int32_t found = keys[cell.begin].second;
      for (std::size_t k = cell.begin; k < cell.end; ++k) {
        const double d2 = (positions.col(keys[k].second).cast<double>() - centre).squaredNorm();
        if (d2 >= least) continue;
        least = d2;
        found = keys[k].second;
      }
      nearest.push_back(found);
    }
    return nearest;
  }

  static Cloud with_means(const Cloud& cloud, const std::vector<Key>& keys,
                          const std::vector<Cell>& cells, const Cloud& kept) {
    const velum::Column means = mean_of<float>(cloud.position_column(), keys, cells);
    Cloud out = kept.with_positions(velum::Points(means.as<float>()));
    for (const auto& [name, column] : cloud.columns())
      if (averaged(name, column) && name != velum::column::kNormals)
        out = out.with(name, mean_of(column, keys, cells));
    if (cloud.has(velum::column::kNormals))
      out = out.with(velum::column::kNormals, mean_normals(cloud, keys, cells, kept));
    return out;
  }

  static void report(Index before, Index after, velum::Context& context) {
    context.measure("kept", static_cast<double>(after), "");
    context.measure("points_per_cell",
                    after > 0 ? static_cast<double>(before) / static_cast<double>(after) : 0.0, "");
  }
};

}  // namespace
VELUM_STAGE(VoxelGrid)
