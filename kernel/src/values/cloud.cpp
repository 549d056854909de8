// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "velum/cloud.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <mutex>

namespace velum {
namespace {

/// Points looked at for the spacing.
constexpr Index kSpacingSamples = 20000;
/// A motion may enlarge coordinates this many times about the old origin before a new one is
/// chosen: at most 4 of the 24 bits of a float are given up.
constexpr double kEnlargement = 16.0;

struct Meaning {
  std::string_view name;
  Scalar scalar;
  Index width;
};
constexpr Meaning kMeanings[] = {
    {column::kNormals, Scalar::f32, 3},   {column::kCurvature, Scalar::f32, 1},
    {column::kIntensity, Scalar::f32, 1}, {column::kColour, Scalar::u8, 3},
    {column::kTime, Scalar::f64, 1},      {column::kLabel, Scalar::i32, 1},
    {column::kSensor, Scalar::u8, 1},     {column::kBeam, Scalar::i32, 1},
    {column::kLine, Scalar::i32, 1},      {column::kTilt, Scalar::f32, 1}};

void check_meaning(std::string_view name, const Column& column) {
  for (const Meaning& known : kMeanings) {
    if (known.name != name) continue;
    if (known.scalar == column.scalar() && known.width == column.width()) return;
    throw Error(Fault::stage, fmt::format("column '{}' has type {}x{}, expected {}x{}", name,
                                          name_of(column.scalar()), column.width(),
                                          name_of(known.scalar), known.width));
  }
}

ConstPoints as_points(const Column& column) {
  return {column.as<float>().data(), 3, column.count()};
}

Points moved(const ConstPoints& positions, const Eigen::Matrix3d& rotation,
             const Eigen::Vector3d& shift) {
  Points result(3, positions.cols());
  for (Index i = 0; i < positions.cols(); ++i)
    result.col(i) = (rotation * positions.col(i).cast<double>() + shift).cast<float>();
  return result;
}

double median_spacing(const ConstPoints& positions, const Neighbours& neighbours) {
  const Index count = positions.cols();
  if (count < 2) return 0.0;
  const Index samples = std::min(count, kSpacingSamples);
  std::vector<float> distances;
  distances.reserve(static_cast<std::size_t>(samples));
  std::vector<Neighbour> found;
  for (Index i = 0; i < samples; ++i) {
    neighbours.nearest(positions.col(i * count / samples), 2, found);
    distances.push_back(found.back().distance2);
  }
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return std::sqrt(static_cast<double>(*middle));
}

}  // namespace

/// What copies of a cloud have in common: positions and what is derived from them alone.
struct Cloud::Shared {
  explicit Shared(Column column) : positions(std::move(column)) {}
  Column positions;
  mutable std::once_flag indexed;
  mutable std::unique_ptr<Neighbours> neighbours;
  mutable std::once_flag measured;
  mutable double spacing = 0.0;
};

Cloud::Cloud() : Cloud(Points(3, 0)) {}

Cloud::Cloud(Points positions, const Eigen::Vector3d& origin)
    : Cloud(Column(std::move(positions)), origin) {}

Cloud::Cloud(Column positions, const Eigen::Vector3d& origin) : origin_(origin) {
  if (positions.scalar() != Scalar::f32 || positions.width() != 3)
    throw Error(Fault::stage, fmt::format("positions have type {}x{}, expected f32x3",
                                          name_of(positions.scalar()), positions.width()));
  if (positions.count() > std::numeric_limits<std::int32_t>::max())
    throw Error(Fault::stage, fmt::format("a cloud of {} points; at most 2147483647 are possible",
                                          positions.count()));
  if (!as_points(positions).allFinite() || !origin.allFinite())
    throw Error(Fault::stage, "positions that are not finite numbers");
  shared_ = std::make_shared<const Shared>(std::move(positions));
}

Index Cloud::size() const {
  return shared_->positions.count();
}
ConstPoints Cloud::positions() const {
  return as_points(shared_->positions);
}
const Column& Cloud::position_column() const {
  return shared_->positions;
}

Eigen::Vector3f Cloud::sensor_position(std::size_t index) const {
  if (index >= sensors_.size())
    throw Error(Fault::stage,
                fmt::format("sensor {} of a cloud that has {}", index, sensors_.size()));
  return (sensors_[index].pose.translation() - origin_).cast<float>();
}

std::optional<std::size_t> Cloud::sensor_of(Index point) const {
  if (sensors_.empty()) return std::nullopt;
  const auto found = columns_.find(column::kSensor);
  if (found == columns_.end()) return 0;
  const std::size_t sensor = found->second.vector<std::uint8_t>()(point);
  if (sensor >= sensors_.size()) return std::nullopt;
  return sensor;
}

bool Cloud::has(std::string_view name) const {
  return columns_.find(name) != columns_.end();
}

const Column& Cloud::column(std::string_view name) const {
  const auto found = columns_.find(name);
  if (found == columns_.end())
    throw Error(Fault::stage, fmt::format("the cloud has no column '{}'", name));
  return found->second;
}

ConstPoints Cloud::normals() const {
  return as_points(column(column::kNormals));
}
Eigen::Map<const Eigen::VectorXf> Cloud::curvature() const {
  return column(column::kCurvature).vector<float>();
}
Eigen::Map<const Eigen::VectorXf> Cloud::intensity() const {
  return column(column::kIntensity).vector<float>();
}
Eigen::Map<const Eigen::VectorXi> Cloud::labels() const {
  return column(column::kLabel).vector<std::int32_t>();
}

Cloud Cloud::with(std::string name, Column column) const {
  check_meaning(name, column);
  if (column.count() != size())
    throw Error(Fault::stage, fmt::format("column '{}' has {} elements for {} points", name,
                                          column.count(), size()));
  Cloud result(*this);
  result.columns_.insert_or_assign(std::move(name), std::move(column));
  return result;
}

Cloud Cloud::without(std::string_view name) const {
  Cloud result(*this);
  const auto found = result.columns_.find(name);
  if (found != result.columns_.end()) result.columns_.erase(found);
  return result;
}

Cloud Cloud::with_sensors(std::vector<Sensor> sensors) const {
  Cloud result(*this);
  result.sensors_ = std::move(sensors);
  return result;
}

Cloud Cloud::with_positions(Points positions) const {
  if (positions.cols() != size())
    throw Error(Fault::stage, fmt::format("{} positions for {} points", positions.cols(), size()));
  Cloud result(std::move(positions), origin_);
  result.columns_ = columns_;
  result.sensors_ = sensors_;
  return result;
}

Cloud Cloud::with_origin(const Eigen::Vector3d& origin) const {
  if (origin == origin_) return *this;
  Cloud result = with_positions(moved(positions(), Eigen::Matrix3d::Identity(), origin_ - origin));
  result.origin_ = origin;
  return result;
}

Cloud Cloud::select(std::span<const std::int32_t> indices) const {
  Cloud result(*this);
  result.shared_ = std::make_shared<const Shared>(position_column().select(indices));
  for (auto& [name, column] : result.columns_) column = column.select(indices);
  return result;
}

Cloud Cloud::transformed(const Pose& motion) const {
  if (motion.matrix() == Pose::Identity().matrix()) return *this;
  // R (o + p) + t = (R o + t) + R p: about the moved origin positions are only turned and lose
  // nothing. The old origin stays where coordinates do not grow much, so that clouds keep sharing
  // it.
  const Eigen::Vector3d moved_origin = motion * origin_;
  const Eigen::Vector3d shift = moved_origin - origin_;
  const double extent = empty() ? 0.0 : static_cast<double>(positions().cwiseAbs().maxCoeff());
  const bool keep = empty() || shift.cwiseAbs().maxCoeff() <= (kEnlargement - 2.0) * extent;
  Cloud result = with_positions(
      moved(positions(), motion.linear(), keep ? shift : Eigen::Vector3d::Zero().eval()));
  if (!keep) result.origin_ = moved_origin;
  if (has(column::kNormals))
    result.columns_[column::kNormals] =
        Column(moved(normals(), motion.linear(), Eigen::Vector3d::Zero()));
  for (Sensor& sensor : result.sensors_) sensor.pose = motion * sensor.pose;
  return result;
}

const Neighbours& Cloud::neighbours() const {
  std::call_once(shared_->indexed,
                 [&] { shared_->neighbours = std::make_unique<Neighbours>(positions()); });
  return *shared_->neighbours;
}

double Cloud::spacing() const {
  std::call_once(shared_->measured,
                 [&] { shared_->spacing = median_spacing(positions(), neighbours()); });
  return shared_->spacing;
}

double Cloud::diagonal() const {
  if (empty()) return 0.0;
  return bounding_box(positions()).diagonal().cast<double>().norm();
}

Eigen::AlignedBox3f bounding_box(const ConstPoints& positions) {
  if (positions.cols() == 0) return {};
  return {positions.rowwise().minCoeff().eval(), positions.rowwise().maxCoeff().eval()};
}

}  // namespace velum
