// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include <bit>
#include <cmath>

namespace {

using velum::Cloud;
using velum::Index;

enum class Representative { mean, nearest };

// A cell's number along each axis, from 0; the extent must fit 2²¹ cells.
constexpr int kBits = 21;
constexpr double kMostCells = 2097152.0;

// Cells lie at whole multiples of `size` of true coordinates, so that clouds of one frame share
// them whatever their extent.
class Grid {
 public:
  using Numbers = Eigen::Array<std::int64_t, 3, 1>;

  Grid(const Cloud& cloud, double size) : size_(size), per_metre_(1.0 / size) {
    const Eigen::AlignedBox3f box = velum::bounding_box(cloud.positions());
    const Eigen::Array3d low = cloud.origin().array() + box.min().cast<double>().array();
    const Eigen::Array3d high = cloud.origin().array() + box.max().cast<double>().array();
    const Eigen::Array3d first = (low * per_metre_).floor();
    const double cells = ((high * per_metre_).floor() - first).maxCoeff() + 1.0;
    if (!(cells <= kMostCells))
      throw velum::Error(velum::Fault::stage,
                         "the cloud is more than 2,097,152 cells long; the size is too small")
          .hint("use a larger 'size', or remove far points first");
    offset_ = cloud.origin().array() * per_metre_ - first;
  }
  [[nodiscard]] Numbers at(const Eigen::Vector3f& point) const {
    // Rounding may put a point of the box's low side just below cell 0; whole parts of what is not
    // negative are floors.
    const Eigen::Array3d place = point.cast<double>().array() * per_metre_ + offset_;
    return place.max(0.0).min(kMostCells - 1.0).cast<std::int64_t>();
  }
  [[nodiscard]] std::uint64_t key(const Eigen::Vector3f& point) const {
    const Numbers number = at(point);
    return static_cast<std::uint64_t>((number[0] << (2 * kBits)) | (number[1] << kBits) |
                                      number[2]);
  }
  // Centre of the point's cell, relative to the cloud's origin.
  [[nodiscard]] Eigen::Vector3d centre(const Eigen::Vector3f& point) const {
    return ((at(point).cast<double>() - offset_ + 0.5) * size_).matrix();
  }

 private:
  double size_;
  double per_metre_;
  Eigen::Array3d offset_;
};

// Which cell each point is in, -1 for none; cells are numbered as they first appear.
struct Cells {
  std::vector<std::int32_t> of;
  std::vector<std::int32_t> counts;
  [[nodiscard]] Index size() const { return static_cast<Index>(counts.size()); }
};

std::vector<std::uint64_t> keys_of(const Cloud& cloud, const Grid& grid, velum::Context& context) {
  const auto positions = cloud.positions();
  std::vector<std::uint64_t> keys(static_cast<std::size_t>(cloud.size()));
  velum::parallel_for(context, cloud.size(), 65536, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i)
      keys[static_cast<std::size_t>(i)] = grid.key(positions.col(i));
  });
  return keys;
}

// A table with open addressing: several times faster than sorting the points by their cells.
Cells number_cells(const std::vector<std::uint64_t>& keys) {
  const std::size_t slots = std::bit_ceil(2 * keys.size() + 2);
  const auto shift = static_cast<unsigned int>(64 - std::countr_zero(slots));
  std::vector<std::int32_t> table(slots, -1);
  std::vector<std::uint64_t> key_of_cell;
  Cells cells;
  cells.of.reserve(keys.size());
  for (const std::uint64_t key : keys) {
    std::size_t at = (key * 0x9e3779b97f4a7c15U) >> shift;
    while (table[at] >= 0 && key_of_cell[static_cast<std::size_t>(table[at])] != key)
      at = (at + 1) & (slots - 1);
    if (table[at] < 0) {
      table[at] = static_cast<std::int32_t>(key_of_cell.size());
      key_of_cell.push_back(key);
      cells.counts.push_back(0);
    }
    cells.of.push_back(table[at]);
    ++cells.counts[static_cast<std::size_t>(table[at])];
  }
  return cells;
}

Cells without_small(Cells cells, int min_points) {
  std::vector<std::int32_t> number(cells.counts.size(), -1);
  std::vector<std::int32_t> counts;
  for (std::size_t c = 0; c < number.size(); ++c) {
    if (cells.counts[c] < min_points) continue;
    number[c] = static_cast<std::int32_t>(counts.size());
    counts.push_back(cells.counts[c]);
  }
  for (std::int32_t& cell : cells.of) cell = number[static_cast<std::size_t>(cell)];
  cells.counts = std::move(counts);
  return cells;
}

// What is the same of neighbouring measurements is averaged: numbers with a decimal point, colours
// and normals. Labels, sensors and other counts come from the point nearest to the cell's centre.
bool averaged(const std::string& name, const velum::Column& column) {
  return column.scalar() == velum::Scalar::f32 || column.scalar() == velum::Scalar::f64 ||
         name == velum::column::kColour;
}

template <class T>
velum::Column mean_of(const velum::Column& column, const Cells& cells) {
  const auto values = column.as<T>();
  const Index width = values.rows();
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(width, cells.size());
  for (std::size_t i = 0; i < cells.of.size(); ++i) {
    if (cells.of[i] < 0) continue;
    for (Index k = 0; k < width; ++k)
      sums(k, cells.of[i]) += static_cast<double>(values(k, static_cast<Index>(i)));
  }
  for (Index c = 0; c < cells.size(); ++c) sums.col(c) /= cells.counts[static_cast<std::size_t>(c)];
  if constexpr (std::is_integral_v<T>) sums = sums.array().round();
  return velum::Column(Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>(sums.template cast<T>()));
}

velum::Column mean_of(const velum::Column& column, const Cells& cells) {
  switch (column.scalar()) {
    case velum::Scalar::f64:
      return mean_of<double>(column, cells);
    case velum::Scalar::u8:
      return mean_of<std::uint8_t>(column, cells);
    default:
      return mean_of<float>(column, cells);
  }
}

// The mean of a cell's normals, turned to the side of `kept`'s; `kept`'s own where they cancel.
velum::Column mean_normals(const Cloud& cloud, const Cells& cells, const Cloud& kept) {
  Eigen::Matrix3Xd sums = Eigen::Matrix3Xd::Zero(3, kept.size());
  for (std::size_t i = 0; i < cells.of.size(); ++i) {
    if (cells.of[i] < 0) continue;
    const Eigen::Vector3d n = cloud.normals().col(static_cast<Index>(i)).cast<double>();
    const bool away = n.dot(kept.normals().col(cells.of[i]).cast<double>()) < 0.0;
    sums.col(cells.of[i]) += away ? Eigen::Vector3d(-n) : n;
  }
  velum::Points means = kept.normals();
  for (Index c = 0; c < kept.size(); ++c)
    if (sums.col(c).norm() > 1e-9) means.col(c) = sums.col(c).normalized().cast<float>();
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
    const Cells cells = without_small(number_cells(keys_of(cloud, grid, context)), min_points);
    context.check();
    report(cloud.size(), cells.size(), context);
    if (point == Representative::nearest)
      return cloud.select(nearest_to_centre(cloud, grid, cells));
    return with_means(cloud, grid, cells);
  }

 private:
  static std::vector<std::int32_t> nearest_to_centre(const Cloud& cloud, const Grid& grid,
                                                     const Cells& cells) {
    const auto positions = cloud.positions();
    std::vector<std::int32_t> nearest(cells.counts.size(), -1);
    std::vector<double> least(nearest.size(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < cells.of.size(); ++i) {
      if (cells.of[i] < 0) continue;
      const auto cell = static_cast<std::size_t>(cells.of[i]);
      const Eigen::Vector3f at = positions.col(static_cast<Index>(i));
      const double d2 = (at.cast<double>() - grid.centre(at)).squaredNorm();
      if (d2 >= least[cell]) continue;
      least[cell] = d2;
      nearest[cell] = static_cast<std::int32_t>(i);
    }
    return nearest;
  }

  static Cloud with_means(const Cloud& cloud, const Grid& grid, const Cells& cells) {
    const velum::Column positions = mean_of<float>(cloud.position_column(), cells);
    if (cloud.columns().empty())
      return Cloud(positions, cloud.origin()).with_sensors(cloud.sensors());
    const Cloud kept = cloud.select(nearest_to_centre(cloud, grid, cells));
    Cloud out = kept.with_positions(velum::Points(positions.as<float>()));
    for (const auto& [name, column] : cloud.columns())
      if (averaged(name, column) && name != velum::column::kNormals)
        out = out.with(name, mean_of(column, cells));
    if (cloud.has(velum::column::kNormals))
      out = out.with(velum::column::kNormals, mean_normals(cloud, cells, kept));
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
