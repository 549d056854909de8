// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "shapes/consensus.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "shapes/fit.hpp"

namespace velum::shapes {
namespace {

constexpr Index kGrain = 8192;
constexpr double kDegree = 0.017453292519943295;
constexpr double kNearlyAll = 0.97;

// A shape of the simpler kind to start from, where the members of `shape` could be one.
std::optional<Shape> simpler(Kind kind, Shape shape, const Field& field,
                             const std::vector<std::int32_t>& members) {
  if (kind == Kind::sphere) return std::nullopt;  // no cylinder or cone is nearly one
  shape.kind = kind;
  if (kind == Kind::cylinder) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const std::int32_t i : members) mean += field.positions.col(i).cast<double>();
    mean /= static_cast<double>(members.size());
    const double along = (mean - shape.point).dot(shape.axis);
    shape.radius = along * std::tan(shape.angle);
    shape.point += along * shape.axis;
  }
  return shape;
}

}  // namespace

Field::Field(const Cloud& cloud) : positions(3, 0), normals(3, 0), middle(Eigen::Vector3f::Zero()) {
  if (cloud.empty()) return;
  middle = bounding_box(cloud.positions()).center();
  positions = cloud.positions().colwise() - middle;
  normals = cloud.normals();
}

std::vector<std::int32_t> Field::consensus(const Shape& shape,
                                           const std::vector<std::int32_t>& points, double epsilon,
                                           double angle, Context& context) const {
  const auto near = static_cast<float>(epsilon);
  const auto cosine = static_cast<float>(std::cos(angle));
  const auto count = static_cast<Index>(points.size());
  return parallel_reduce(
      context, count, kGrain, std::vector<std::int32_t>{},
      [&](Index begin, Index end) {
        std::vector<std::int32_t> part;
        with_probe(shape, [&](const auto& probe) {
          for (Index i = begin; i < end; ++i) {
            const std::int32_t p = points[static_cast<std::size_t>(i)];
            if (agrees(probe(positions.col(p), normals.col(p)), near, cosine)) part.push_back(p);
          }
        });
        return part;
      },
      [](std::vector<std::int32_t>& total, const std::vector<std::int32_t>& part) {
        total.insert(total.end(), part.begin(), part.end());
      });
}

Shape polished(const Field& field, Shape shape, const std::vector<std::int32_t>& points,
               const Search& search, std::vector<std::int32_t>& members, Context& context) {
  members = field.consensus(shape, points, search.epsilon, search.angle, context);
  for (int round = 0; round < 6; ++round) {
    // The first fit looks a little wider, as a sample of three leans out of the band at its ends.
    const double band = round < 2 ? 2.0 * search.epsilon : search.epsilon;
    const auto near = field.consensus(shape, points, band, search.angle, context);
    const Shape trial = refine(shape, field.positions, near, context);
    if (!admissible(trial, search)) break;
    auto agreed = field.consensus(trial, points, search.epsilon, search.angle, context);
    if (agreed.size() < members.size() || (round > 1 && agreed.size() == members.size())) {
      if (round < 2) continue;
      break;
    }
    shape = trial;
    members = std::move(agreed);
  }
  return shape;
}

Shape simplest(const Field& field, const Shape& shape, const std::vector<std::int32_t>& points,
               const Search& search, std::vector<std::int32_t>& members, Context& context) {
  const auto enough = static_cast<double>(members.size()) * kNearlyAll;
  for (const Kind kind : kAllKinds) {
    if (kind >= shape.kind || std::ranges::find(search.kinds, kind) == search.kinds.end()) continue;
    const auto start = simpler(kind, shape, field, members);
    if (!start) continue;
    std::vector<std::int32_t> agreed;
    const Shape trial = polished(field, refine(*start, field.positions, members, context), points,
                                 search, agreed, context);
    if (admissible(trial, search) && static_cast<double>(agreed.size()) >= enough) {
      members = std::move(agreed);
      return trial;
    }
  }
  return shape;
}

bool admissible(const Shape& shape, const Search& search) {
  if (!shape.point.allFinite() || !shape.axis.allFinite()) return false;
  switch (shape.kind) {
    case Kind::sphere:
    case Kind::cylinder:
      return shape.radius > search.epsilon && shape.radius <= search.max_radius;
    case Kind::cone:
      return shape.angle >= 3.0 * kDegree && shape.angle <= 80.0 * kDegree;
    default:
      return true;
  }
}

}  // namespace velum::shapes
