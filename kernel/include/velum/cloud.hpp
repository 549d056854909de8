// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "velum/column.hpp"
#include "velum/neighbours.hpp"

namespace velum {

/// A scanner that saw (part of) a cloud: its pose maps the scanner's frame to the cloud's,
/// origin included.
struct Sensor {
  std::string name;
  Pose pose = Pose::Identity();
};

/// A set of points [m] with optional columns. Immutable and cheap to copy: columns are shared, and
/// so are the neighbour index and the spacing, which are made on first use.
///
/// The true position of point i is `origin() + positions().col(i)`, so that large coordinates lose
/// nothing in single precision. Positions are finite.
class VELUM_API Cloud {
 public:
  Cloud();
  explicit Cloud(Points positions, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());
  /// Positions as a 3-wide f32 column; throws Error when they are not, or not finite.
  explicit Cloud(Column positions, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

  [[nodiscard]] Index size() const;
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] ConstPoints positions() const;
  [[nodiscard]] const Column& position_column() const;
  [[nodiscard]] const Eigen::Vector3d& origin() const { return origin_; }
  [[nodiscard]] const std::vector<Sensor>& sensors() const { return sensors_; }
  /// Where sensor `index` stands, relative to origin [m].
  [[nodiscard]] Eigen::Vector3f sensor_position(std::size_t index) const;
  /// Index into sensors() of the one that saw point i: its `sensor` column, else 0. Empty when the
  /// cloud has no sensors.
  [[nodiscard]] std::optional<std::size_t> sensor_of(Index point) const;

  [[nodiscard]] const Columns& columns() const { return columns_; }
  [[nodiscard]] bool has(std::string_view name) const;
  /// Throws Error (Fault::stage) naming the column when the cloud does not have it.
  [[nodiscard]] const Column& column(std::string_view name) const;

  [[nodiscard]] ConstPoints normals() const;
  [[nodiscard]] Eigen::Map<const Eigen::VectorXf> curvature() const;
  [[nodiscard]] Eigen::Map<const Eigen::VectorXf> intensity() const;
  [[nodiscard]] Eigen::Map<const Eigen::VectorXi> labels() const;

  /// The same cloud with a column added or replaced; throws Error when its count is not size().
  [[nodiscard]] Cloud with(std::string name, Column column) const;
  [[nodiscard]] Cloud without(std::string_view name) const;
  [[nodiscard]] Cloud with_sensors(std::vector<Sensor> sensors) const;
  /// Other positions for the same points: all columns stay.
  [[nodiscard]] Cloud with_positions(Points positions) const;
  /// The same points about another origin.
  [[nodiscard]] Cloud with_origin(const Eigen::Vector3d& origin) const;
  /// The points at `indices`, in that order, with all their columns.
  [[nodiscard]] Cloud select(std::span<const std::int32_t> indices) const;
  /// Positions, normals and sensors moved by `motion`, which acts on true positions.
  [[nodiscard]] Cloud transformed(const Pose& motion) const;

  /// The index of these positions, made on first use and shared by all copies. Thread-safe.
  [[nodiscard]] const Neighbours& neighbours() const;
  /// Median distance to the nearest other point [m] (of at most 20,000 evenly chosen points); 0 for
  /// fewer than two points.
  [[nodiscard]] double spacing() const;
  /// Length of the bounding box's diagonal [m].
  [[nodiscard]] double diagonal() const;

 private:
  struct Shared;
  std::shared_ptr<const Shared> shared_;
  Columns columns_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::vector<Sensor> sensors_;
};

/// All points of `clouds` about the first one's origin: the columns that every cloud has, and all
/// sensors (the `sensor` column is renumbered). Throws Error when columns of one name differ in
/// type.
VELUM_API Cloud merge(std::span<const Cloud> clouds);

/// Frame and extent of a set of positions.
VELUM_API Eigen::AlignedBox3f bounding_box(const ConstPoints& positions);

}  // namespace velum
