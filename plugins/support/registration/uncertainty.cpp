// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/uncertainty.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/eigen3.hpp"
#include "geometry/plane_fit.hpp"
#include "registration/weighed_pairs.hpp"

namespace velum::registration {
namespace {

/// Pairs whose surroundings are looked at where the target has no normals.
constexpr Index kSampled = 2048;
constexpr Index kSurroundings = 64;
/// A set of points is a line, or one place, when its next spread is below this share of the larger.
constexpr double kThin = 1e-4;

double largest_deviation(const Eigen::Matrix3d& covariance) {
  return std::sqrt(std::max(0.0, geometry::eigen3(covariance).values[2]));
}

/// Rows for the directions in which the surface about `match` holds a point: across a plane, square
/// to a line, all for a lone place.
void add_surface(NormalEquations& sums, const Cloud& target, const Pair& pair, std::int32_t match,
                 std::vector<Neighbour>& found) {
  const Eigen::Vector3f at = target.positions().col(match);
  target.neighbours().nearest(at, kSurroundings, found);
  geometry::PointMoments moments(at.cast<double>());
  for (const Neighbour& neighbour : found)
    moments.add(target.positions().col(neighbour.index).cast<double>());
  const geometry::Eigen3 axes = geometry::eigen3(moments.covariance());
  sums.add(pair.point, axes.vectors.col(0), 0.0, pair.weight);
  if (axes.values[1] > kThin * axes.values[2]) return;
  sums.add(pair.point, axes.vectors.col(1), 0.0, pair.weight);
  if (axes.values[2] > 0.0) return;
  sums.add(pair.point, axes.vectors.col(2), 0.0, pair.weight);
}

/// The equations of point to plane for every step-th pair, brought to the weight of all.
NormalEquations sampled_surfaces(const WeighedPairs& pairs, const Eigen::Vector3d& centre,
                                 Context& context) {
  const Index step = std::max<Index>(1, pairs.size() / kSampled);
  const Index count = (pairs.size() + step - 1) / step;
  const auto part = [&](Index begin, Index end) {
    NormalEquations sums(centre);
    std::vector<Neighbour> found;
    Pair pair;
    for (Index k = begin; k < end; ++k)
      if (pairs.get(k * step, pair))
        add_surface(sums, pairs.target(), pair, pairs.closest().match(k * step), found);
    return sums;
  };
  NormalEquations all =
      parallel_reduce(context, count, kSampled / 8, NormalEquations(centre), part,
                      [](NormalEquations& total, const NormalEquations& one) { total.add(one); });
  all.scale(static_cast<double>(step));
  return all;
}

/// Σ over target points of (Σ of its pairs' w·gap·row) squared, the rows with turns as arcs.
Matrix6 scatter(const WeighedPairs& pairs, const Eigen::Vector3d& centre, double radius) {
  std::vector<Vector6> pulls(static_cast<std::size_t>(pairs.target().size()), Vector6::Zero());
  Pair pair;
  for (Index i = 0; i < pairs.size(); ++i) {
    if (!pairs.get(i, pair)) continue;
    const Eigen::Vector3d force = pairs.planar() ? Eigen::Vector3d(pair.gap * pair.normal)
                                                 : Eigen::Vector3d(pair.target - pair.point);
    Vector6 pull;
    pull << (pair.at - centre).cross(force) / radius, force;
    pulls[static_cast<std::size_t>(pairs.closest().match(i))] += pair.weight * pull;
  }
  Matrix6 sum = Matrix6::Zero();
  for (const Vector6& pull : pulls) sum.noalias() += pull * pull.transpose();
  return sum;
}

}  // namespace

double Uncertainty::rotation() const {
  return largest_deviation(covariance.topLeftCorner<3, 3>());
}

double Uncertainty::translation() const {
  return largest_deviation(covariance.bottomRightCorner<3, 3>());
}

Uncertainty estimate_uncertainty(const WeighedPairs& pairs, const NormalEquations* surfaces,
                                 const Eigen::Vector3d& centre, double radius, Context& context) {
  context.check();
  radius = std::max(radius, 1e-300);
  const NormalEquations equations =
      surfaces != nullptr ? *surfaces : sampled_surfaces(pairs, centre, context);
  Uncertainty result;
  result.centre = centre;
  result.directions = equations.directions(radius);
  const Matrix6 middle =
      result.directions.axes.transpose() * scatter(pairs, centre, radius) * result.directions.axes;
  Matrix6 inverse = Matrix6::Zero();
  for (int k = 0; k < 6; ++k) {
    const double information = result.directions.strength[k] * equations.weight();
    if (result.directions.strength[k] < kFreeStrength) {
      result.deviation[k] = std::numeric_limits<double>::infinity();
      ++result.free;
    } else {
      inverse.col(k) = result.directions.axes.col(k) / information;
      result.deviation[k] = std::sqrt(std::max(0.0, middle(k, k))) / information;
    }
  }
  Vector6 unit = Vector6::Ones();
  unit.head<3>() /= radius;
  const Matrix6 covariance =
      unit.asDiagonal() * (inverse * middle * inverse.transpose()) * unit.asDiagonal();
  result.covariance = 0.5 * (covariance + covariance.transpose());
  return result;
}

Table directions_table(const Uncertainty& uncertainty) {
  Table table({{"strength", ""},
               {"deviation", "m"},
               {"free", ""},
               {"turn_x", ""},
               {"turn_y", ""},
               {"turn_z", ""},
               {"shift_x", ""},
               {"shift_y", ""},
               {"shift_z", ""},
               {"radius", "m"}});
  const auto& directions = uncertainty.directions;
  for (int k = 0; k < 6; ++k) {
    const Vector6 axis = directions.axes.col(k);
    table.add({directions.strength[k], uncertainty.deviation[k],
               static_cast<std::int64_t>(directions.strength[k] < kFreeStrength ? 1 : 0), axis[0],
               axis[1], axis[2], axis[3], axis[4], axis[5], directions.radius});
  }
  return table;
}

Table covariance_table(const Uncertainty& uncertainty) {
  const std::array<const char*, 6> names{"turn_x",  "turn_y",  "turn_z",
                                         "shift_x", "shift_y", "shift_z"};
  Table table({{"parameter", ""},
               {"turn_x", "rad"},
               {"turn_y", "rad"},
               {"turn_z", "rad"},
               {"shift_x", "m"},
               {"shift_y", "m"},
               {"shift_z", "m"}});
  for (int r = 0; r < 6; ++r) {
    const auto row = uncertainty.covariance.row(r);
    table.add({std::string(names[static_cast<std::size_t>(r)]), row[0], row[1], row[2], row[3],
               row[4], row[5]});
  }
  return table;
}

}  // namespace velum::registration
