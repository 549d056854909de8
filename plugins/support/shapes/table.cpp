// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "shapes/table.hpp"

#include <algorithm>
#include <numeric>

#include "geometry/plane_fit.hpp"
#include "shapes/fit.hpp"

namespace velum::shapes {
namespace {

using Eigen::Vector3d;

// One of the two ways that an axis can point: towards the first scanner, else upwards.
Vector3d facing(const Cloud& cloud, const Vector3d& from, const Vector3d& axis) {
  if (!cloud.sensors().empty()) {
    const Vector3d eye = cloud.sensor_position(0).cast<double>();
    if (std::abs(axis.dot(eye - from)) > 0.0) return axis.dot(eye - from) < 0.0 ? -axis : axis;
  }
  const double sign = axis.z() != 0.0 ? axis.z() : axis.y() != 0.0 ? axis.y() : axis.x();
  return sign < 0.0 ? Vector3d(-axis) : axis;
}

struct Extent {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
  Vector3d high = -low;
  void add(const Vector3d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
};

std::vector<Cell> row_of(const Cloud& cloud, const Labelled& found, std::size_t number,
                         const std::vector<std::int32_t>& members, Context& context) {
  const auto positions = cloud.positions();
  geometry::PointMoments moments(positions.col(members.front()).cast<double>());
  for (const std::int32_t i : members) moments.add(positions.col(i).cast<double>());
  const geometry::Eigen3 axes = geometry::eigen3(moments.covariance());
  const Vector3d centre = moments.centroid();
  const auto& known = found.shapes[number];
  Shape shape = known.value_or(Shape{.point = centre, .axis = axes.vectors.col(0)});
  Extent box;
  Extent along;
  double squares = 0.0;
  for (const std::int32_t i : members) {
    const Vector3d p = positions.col(i).cast<double>();
    box.add(axes.vectors.transpose() * (p - centre));
    along.add(Vector3d::Constant((p - shape.point).dot(shape.axis)));
    squares += shape.distance(p) * shape.distance(p);
  }
  context.check();
  if (shape.kind == Kind::plane) {
    shape.point = centre - shape.distance(centre) * shape.axis;
    shape.axis = facing(cloud, shape.point, shape.axis);
  } else if (shape.kind == Kind::cylinder) {
    shape.point += 0.5 * (along.low.x() + along.high.x()) * shape.axis;
    shape.axis = facing(Cloud(), shape.point, shape.axis);
  } else if (shape.kind == Kind::sphere) {
    shape.axis.setZero();
  }
  const Vector3d point = shape.point + cloud.origin();
  const Vector3d extent = box.high - box.low;
  return {static_cast<std::int64_t>(number),
          static_cast<std::int64_t>(members.size()),
          known ? std::string(name_of(shape.kind)) : std::string("region"),
          found.scores[number],
          std::sqrt(squares / static_cast<double>(members.size())),
          point.x(),
          point.y(),
          point.z(),
          shape.axis.x(),
          shape.axis.y(),
          shape.axis.z(),
          shape.radius,
          shape.angle,
          extent[2],
          extent[1],
          extent[0]};
}

Table empty_table() {
  Table table({{"cluster", ""},
               {"points", ""},
               {"model", ""},
               {"score", ""},
               {"rms", "m"},
               {"point_x", "m"},
               {"point_y", "m"},
               {"point_z", "m"},
               {"axis_x", ""},
               {"axis_y", ""},
               {"axis_z", ""},
               {"radius", "m"},
               {"angle", "rad"},
               {"length", "m"},
               {"width", "m"},
               {"depth", "m"}});
  return table;
}

}  // namespace

Labelled labelled(Detection detection) {
  Labelled made;
  made.labels = std::move(detection.labels);
  for (const Found& one : detection.shapes) {
    made.shapes.emplace_back(one.shape);
    made.scores.push_back(static_cast<double>(one.consensus));
  }
  return made;
}

Clusters clusters_of(const Cloud& cloud, Labelled found, Context& context) {
  std::vector<std::vector<std::int32_t>> members(found.shapes.size());
  for (Index i = 0; i < found.labels.size(); ++i)
    if (found.labels[i] >= 0)
      members[static_cast<std::size_t>(found.labels[i])].push_back(static_cast<std::int32_t>(i));
  std::vector<std::vector<Cell>> rows(members.size());
  parallel_for(context, static_cast<Index>(members.size()), 1, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const auto c = static_cast<std::size_t>(k);
      rows[c] = row_of(cloud, found, c, members[c], context);
    }
  });
  Table kinds = empty_table();
  for (auto& row : rows) kinds.add(std::move(row));
  return {cloud, Column(std::move(found.labels)), std::move(kinds)};
}

Index keep_sizes(Labelled& found, Index least, Index most) {
  std::vector<Index> sizes(found.shapes.size(), 0);
  for (const int label : found.labels)
    if (label >= 0) ++sizes[static_cast<std::size_t>(label)];
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), 0U);
  std::erase_if(order, [&](std::size_t c) { return sizes[c] < least || sizes[c] > most; });
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
  std::vector<int> number(sizes.size(), -1);
  Labelled kept;
  for (const std::size_t c : order) {
    number[c] = static_cast<int>(kept.shapes.size());
    kept.shapes.push_back(found.shapes[c]);
    kept.scores.push_back(found.scores[c]);
  }
  for (int& label : found.labels)
    if (label >= 0) label = number[static_cast<std::size_t>(label)];
  kept.labels = std::move(found.labels);
  found = std::move(kept);
  return static_cast<Index>(sizes.size() - order.size());
}

void measure(const Clusters& clusters, Context& context) {
  const auto all = static_cast<double>(clusters.cloud.size());
  const auto assigned = static_cast<double>((clusters.label().array() >= 0).count());
  context.measure("clusters", static_cast<double>(clusters.kinds.size()), "");
  context.measure("assigned", all > 0.0 ? assigned / all : 0.0, "");
  context.measure("largest", clusters.kinds.empty() ? 0.0 : clusters.kinds.number(0, "points"), "");
}

}  // namespace velum::shapes
