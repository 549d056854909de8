// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "mls/fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

#include "geometry/eigen3.hpp"

namespace velum::mls {
namespace {

using Found = std::span<const Neighbour>;

// The variance of a fitted height, in units of σ² over the number of points, is below 4 for orders
// 2 and 3 in the middle of a disc and 5 to 10 at its rim, where order 1 has 3. That of the two
// slopes together is 8 in the middle for orders 1 and 2, and several times that at the rim and for
// order 3. Above these bounds a lower order is tried.
constexpr double kOneSided = 4.5;
constexpr double kOneSidedSlope = 10.0;
// Above this bound an order is no longer a fit: it runs through its points.
constexpr double kMostLeverage = 40.0;
// The lower order is taken when the two differ by less than this many variances of their
// difference: its bias is then likely to be less than the noise that it saves.
constexpr double kLikely = 4.0;
// A neighbourhood is a line when its second extent is below this share of its first (squared).
constexpr double kLine = 1e-8;

double count_of(const Support& support, std::int32_t index) {
  return support.counts.empty()
             ? 1.0
             : static_cast<double>(support.counts[static_cast<std::size_t>(index)]);
}

// The plane H with its axes: columns of `vectors` are normal, second and first direction.
struct Plane {
  geometry::Eigen3 axes;
  Eigen::Vector3d mean;  // relative to the point
};

std::optional<Plane> fit_plane(const Support& support, const Eigen::Vector3f& point, Found found,
                               double h2) {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = 0.0;
  for (const Neighbour& n : found) {
    const Eigen::Vector3d d = (support.points.col(n.index) - point).cast<double>();
    const double w = count_of(support, n.index) * std::exp(-static_cast<double>(n.distance2) / h2);
    sum += w * d;
    squares.noalias() += (w * d) * d.transpose();
    weights += w;
  }
  if (found.size() < 3 || !(weights > 0.0)) return std::nullopt;
  Plane plane;
  plane.mean = sum / weights;
  plane.axes = geometry::eigen3(squares / weights - plane.mean * plane.mean.transpose());
  if (plane.axes.values[1] <= kLine * plane.axes.values[2]) return std::nullopt;
  return plane;
}

// A neighbour over H: place in units of the radius, height in metres, weight.
struct Height {
  double x, y, f, w;
};

template <int Order>
using Terms = Eigen::Matrix<double, (Order + 1) * (Order + 2) / 2, 1>;

template <int Order>
Terms<Order> terms_at(double x, double y) {
  Terms<Order> row;
  row[0] = 1.0;
  if constexpr (Order >= 1) row.template segment<2>(1) << x, y;
  if constexpr (Order >= 2) row.template segment<3>(3) << x * x, x * y, y * y;
  if constexpr (Order >= 3)
    row.template segment<4>(6) << x * x * x, x * x * y, x * y * y, y * y * y;
  return row;
}

// The polynomial at the foot. Variances are in units of σ², leverages are variance times weight.
struct Polynomial {
  double height = 0.0;   // [m]
  double slope_x = 0.0;  // [m per radius]
  double slope_y = 0.0;
  double variance = 0.0;
  double leverage = 0.0;
  double slope_variance = 0.0;
  double slope_leverage = 0.0;
  double residual2 = 0.0;  // weighted mean square [m²]
  double noise2 = 0.0;     // σ² [m²], as the residuals show it
};

// Weighted least squares (3.39); nothing where the neighbours do not determine it.
template <int Order>
std::optional<Polynomial> fit_order(std::span<const Height> heights) {
  constexpr int kTerms = Terms<Order>::RowsAtCompileTime;
  if constexpr (Order >= 2)
    if (heights.size() < kTerms + 2) return std::nullopt;
  Eigen::Matrix<double, kTerms, kTerms> normal = Eigen::Matrix<double, kTerms, kTerms>::Zero();
  Terms<Order> right = Terms<Order>::Zero();
  double weights = 0.0, squares = 0.0;
  for (const Height& at : heights) {
    const Terms<Order> row = terms_at<Order>(at.x, at.y);
    const Terms<Order> weighted = at.w * row;
    normal.noalias() += weighted * row.transpose();
    right += at.f * weighted;
    weights += at.w;
    squares += at.w * at.f * at.f;
  }
  const Eigen::LDLT<Eigen::Matrix<double, kTerms, kTerms>> solver(normal);
  const auto pivots = solver.vectorD();
  if (!(pivots.minCoeff() > 1e-10 * pivots.maxCoeff())) return std::nullopt;
  const Terms<Order> c = solver.solve(right);
  Polynomial fitted;
  fitted.height = c[0];
  fitted.variance = solver.solve(Terms<Order>::Unit(0).eval())[0];
  fitted.leverage = weights * fitted.variance;
  if constexpr (Order >= 1) {
    fitted.slope_x = c[1];
    fitted.slope_y = c[2];
    fitted.slope_variance = solver.solve(Terms<Order>::Unit(1).eval())[1] +
                            solver.solve(Terms<Order>::Unit(2).eval())[2];
    fitted.slope_leverage = weights * fitted.slope_variance;
  }
  const double misfit = std::max(squares - right.dot(c), 0.0);
  const double freedoms = static_cast<double>(heights.size()) - kTerms;
  fitted.residual2 = misfit / weights;
  fitted.noise2 = freedoms > 0.0 ? misfit / freedoms : 0.0;
  return fitted;
}

std::optional<Polynomial> fit_order(std::span<const Height> heights, int order) {
  switch (order) {
    case 3:
      return fit_order<3>(heights);
    case 2:
      return fit_order<2>(heights);
    case 1:
      return fit_order<1>(heights);
    default:
      return fit_order<0>(heights);
  }
}

// Near the least number of points the residuals of the higher order say little.
double noise2(const Polynomial& best, const Polynomial& lower) {
  return std::max(best.noise2, lower.noise2);
}

// The height of the lower order, where that of `best` is one-sided and does not speak against it.
bool take_height(Polynomial& best, const Polynomial& lower) {
  const double gap = best.height - lower.height;
  if (best.leverage <= kOneSided ||
      gap * gap > kLikely * (best.variance - lower.variance) * noise2(best, lower))
    return false;
  best.height = lower.height;
  best.variance = lower.variance;
  best.leverage = lower.leverage;
  best.residual2 = lower.residual2;
  return true;
}

// The slopes likewise.
void take_slopes(Polynomial& best, const Polynomial& lower) {
  const double x = best.slope_x - lower.slope_x, y = best.slope_y - lower.slope_y;
  if (best.slope_leverage <= kOneSidedSlope ||
      x * x + y * y > kLikely * (best.slope_variance - lower.slope_variance) * noise2(best, lower))
    return;
  best.slope_x = lower.slope_x;
  best.slope_y = lower.slope_y;
  best.slope_variance = lower.slope_variance;
  best.slope_leverage = lower.slope_leverage;
}

// The polynomial of the order that serves best, at most `order`, which becomes it.
std::optional<Polynomial> fit_best(std::span<const Height> heights, int& order, bool may_lower) {
  std::optional<Polynomial> best;
  for (; order >= 0; --order) {
    best = fit_order(heights, order);
    if (best && (order <= 1 || best->leverage <= kMostLeverage)) break;
  }
  for (int lower = order - 1; best && may_lower && lower >= 1; --lower) {
    const auto candidate = fit_order(heights, lower);
    if (!candidate) break;
    if (take_height(*best, *candidate)) order = lower;
    take_slopes(*best, *candidate);
  }
  return best;
}

// Neighbours in the frame of H about the foot, with weights by the distance to it (3.40).
void measure_heights(const Support& support, const Eigen::Vector3f& point, Found found,
                     const Plane& plane, const Eigen::Vector3d& foot, const FitOptions& options,
                     std::vector<Height>& heights) {
  const double h2 = options.gaussian * options.gaussian;
  heights.clear();
  for (const Neighbour& n : found) {
    const Eigen::Vector3d d = (support.points.col(n.index) - point).cast<double>() - foot;
    const Eigen::Vector3d along = plane.axes.vectors.transpose() * d;
    heights.push_back({along[2] / options.radius, along[1] / options.radius, along[0],
                       count_of(support, n.index) * std::exp(-d.squaredNorm() / h2)});
  }
}

}  // namespace

std::optional<LocalSurface> fit_surface(const Support& support, const Eigen::Vector3f& point,
                                        Found found, const FitOptions& options) {
  const auto plane = fit_plane(support, point, found, options.gaussian * options.gaussian);
  if (!plane) return std::nullopt;
  const Eigen::Vector3d axis = plane->axes.vectors.col(0);
  const Eigen::Vector3d foot = plane->mean.dot(axis) * axis;
  thread_local std::vector<Height> heights;
  measure_heights(support, point, found, *plane, foot, options, heights);
  LocalSurface surface;
  surface.order = options.order;
  const auto fitted = fit_best(heights, surface.order, options.lower);
  if (!fitted) return std::nullopt;
  surface.step = foot + fitted->height * axis;
  surface.normal = (axis - fitted->slope_x / options.radius * plane->axes.vectors.col(2) -
                    fitted->slope_y / options.radius * plane->axes.vectors.col(1))
                       .normalized();
  const Eigen::Vector3d& values = plane->axes.values;
  const double bend = std::clamp(values[0] - fitted->residual2, 0.0, std::max(values[0], 0.0));
  surface.curvature = bend / (bend + values[1] + values[2]);
  surface.variance = fitted->variance;
  surface.slope_variance = fitted->slope_variance / (options.radius * options.radius);
  surface.slope_leverage = fitted->slope_leverage;
  return surface;
}

}  // namespace velum::mls
