// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "trimming.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "closing.hpp"
#include "sail/lattice.hpp"
#include "scan_edge.hpp"

namespace velum::meshing {
namespace {

using Eigen::Matrix2Xd;
using Eigen::Matrix3Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kInside = 0.75;  // scan steps inside the curve from which on a return counts less
constexpr int kRounds = 5;

// The unrolled plane as a flat sail: x aft, z up.
Matrix3Xd upright(const Matrix2Xd& plane) {
  Matrix3Xd points = Matrix3Xd::Zero(3, plane.cols());
  points.row(0) = plane.row(0);
  points.row(2) = plane.row(1);
  return points;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Signed distance of p from a curve, positive on its left.
double off_curve(const sail::Curve& curve, const Vector3d& p) {
  const Index last = curve.points().cols() - 1;
  const double at = curve.nearest(p) * static_cast<double>(last);
  const auto k = std::min(static_cast<Index>(at), last - 1);
  const Vector3d from = curve.points().col(k);
  const Vector3d along = (curve.points().col(k + 1) - from).normalized();
  const Vector3d gap = p - from;
  return along.x() * gap.z() - along.z() * gap.x();
}

// How far outside the border's curve a point of the edge lies. The outline runs clockwise.
double outside(const sail::Outline& outline, const sail::Border& border,
               const sail::EdgePoints& edge, Index i) {
  const double arc = edge.arc[i];
  const Vector3d p = edge.points.col(i);
  if (arc <= outline.arc[outline.head]) return off_curve(border.luff, p);
  if (arc < outline.arc[outline.peak]) return off_curve(border.top, p);
  if (arc <= outline.arc[outline.clew]) return -off_curve(border.leech, p);
  return -off_curve(border.foot, p);
}

// A return far inside, such as the last one left of a thinned line, is no witness of the edge.
sail::Border fit_border(const sail::Outline& outline, sail::EdgePoints edge,
                        const VectorXd& steps) {
  sail::Border border = sail::make_border(outline, edge);
  const VectorXd given = edge.weights;
  for (int round = 0; round < kRounds; ++round) {
    for (Index i = 0; i < edge.arc.size(); ++i) {
      const double in = -outside(outline, border, edge, i) / (kInside * steps[i]);
      edge.weights[i] = given[i] / (1.0 + (in > 1.0 ? 20.0 * (in - 1.0) : 0.0));
    }
    border = sail::make_border(outline, edge);
  }
  return border;
}

// Are the points between head and peak so few that the line through them is no edge?
bool thin_top(const sail::Outline& outline, const PointOutline& found) {
  std::vector<double> there;
  for (Index i = outline.head; i <= outline.peak; ++i) {
    const std::int32_t place = outline.places[static_cast<std::size_t>(i)];
    there.push_back(found.spacing[found.loop[static_cast<std::size_t>(place)]]);
  }
  std::vector<double> all(found.spacing.begin(), found.spacing.end());
  return median(std::move(there)) > 1.5 * median(std::move(all));
}

// Direction of the last fifth of a curve that goes upward: the very end is its least certain part.
Vector3d rising(const sail::Curve& curve) {
  const Index last = curve.points().cols() - 1;
  Vector3d out = (curve.back() - curve.points().col(last - last / 5 - 1)).normalized();
  if (out.z() < 0.3) out << 0.0, 0.0, 1.0;
  return out;
}

sail::Curve raised(const sail::Curve& curve, double z) {
  const Vector3d out = rising(curve);
  return curve.ending_at(curve.back() + out * ((z - curve.back().z()) / out.z()));
}

// A pointed head goes on above the highest return by as much as would have held one return more, at
// the density of the returns below it.
void raise_head(const sail::Outline& outline, const Matrix2Xd& plane, sail::Border& border) {
  constexpr std::size_t kCounted = 5;
  if (outline.has_top || plane.cols() < static_cast<Index>(4 * kCounted)) return;
  std::vector<double> heights(plane.row(1).begin(), plane.row(1).end());
  std::nth_element(heights.begin(), heights.begin() + kCounted, heights.end(), std::greater<>());
  const double below = heights[kCounted];
  const double top = plane.row(1).maxCoeff();
  constexpr int kSteps = 200;
  const auto width = [&](double z) {
    const auto at = [&](const sail::Curve& curve) {
      const auto found = curve.at_height(z);
      if (found) return found->x();
      const Vector3d out = rising(curve);
      return curve.back().x() + out.x() * (z - curve.back().z()) / out.z();
    };
    return at(border.leech) - at(border.luff);
  };
  const double step = (top - below) / kSteps;
  double area = 0.0;
  for (int i = 0; i < kSteps; ++i) area += std::max(0.0, width(below + (i + 0.5) * step)) * step;
  const double wanted = area / static_cast<double>(kCounted);
  double level = top;
  // Never farther than the five returns reach.
  for (double more = 0.0; more < wanted && level < top + (top - below); level += step) {
    const double across = width(level);
    if (across <= 0.0) break;
    more += across * step;
  }
  if (level <= border.head().z()) return;
  border.luff = raised(border.luff, level);
  border.leech = raised(border.leech, level);
  Matrix3Xd edge(3, 2);
  edge << border.head(), border.peak();
  border.top = sail::Curve(edge);
}

// A curve that leaves the points behind was led astray.
void check_near(const TrimmingCurve& curve, const Matrix2Xd& plane, const PointOutline& found) {
  constexpr double kFar = 6.0;  // spacings
  for (Index i = 0; i < curve.loop.cols(); i += 4) {
    double least = std::numeric_limits<double>::infinity();
    double spacing = 0.0;
    for (const std::int32_t v : found.near) {
      const double off = (plane.col(v) - curve.loop.col(i)).norm();
      if (off >= least) continue;
      least = off;
      spacing = found.spacing[v];
    }
    if (least > kFar * spacing)
      throw Error(Fault::stage, "the border's curves leave the outermost points");
  }
}

}  // namespace

TrimmingCurve smooth_border(const Cloud& cloud, const FittedSheet& sheet, const Matrix2Xd& plane,
                            const PointOutline& found) {
  Matrix2Xd loop(2, static_cast<Index>(found.loop.size()));
  for (Index i = 0; i < loop.cols(); ++i)
    loop.col(i) = plane.col(found.loop[static_cast<std::size_t>(i)]);
  const Eigen::Matrix3Xd polygon = upright(loop);
  const double spacing = polygon.cols() < 8 ? 0.0 : sail::median_edge(polygon);
  if (!(spacing > 0.0)) throw Error(Fault::stage, "the border has fewer than eight points");
  sail::Outline outline = sail::find_corners(polygon, spacing);
  if (outline.has_top && thin_top(outline, found)) {
    Index apex = outline.head;
    for (Index i = outline.head; i <= outline.peak; ++i)
      if (outline.points(2, i) > outline.points(2, apex)) apex = i;
    outline.head = outline.peak = apex;
    outline.has_top = false;
  }

  sail::EdgePoints edge = sail::edge_as_is(outline);
  VectorXd steps = VectorXd::Constant(edge.arc.size(), spacing);
  if (sail::is_scan(cloud)) {
    edge = scan_edge(cloud, sheet, found, plane);
    std::vector<double> lengths;
    steps.resize(edge.arc.size());
    for (Index i = 0; i < edge.arc.size(); ++i) {
      edge.arc[i] = sail::place_on(outline, edge.points.col(i));
      steps[i] = std::max(2.0 * edge.moves.col(i).norm(), 1e-3 * spacing);
      lengths.push_back(steps[i]);
    }
    if (lengths.empty()) throw Error(Fault::stage, "no scan line ends at the border");
    edge.step = median(lengths);
  }
  sail::Border border = fit_border(outline, edge, steps);
  raise_head(outline, plane, border);
  TrimmingCurve curve = closed(border);
  check_near(curve, plane, found);
  curve.moved = edge.step * 0.5;
  return curve;
}

TrimmingCurve plain_border(const Matrix2Xd& plane, const std::vector<std::int32_t>& loop) {
  TrimmingCurve curve;
  curve.loop.resize(2, static_cast<Index>(loop.size()));
  for (std::size_t i = 0; i < loop.size(); ++i)
    curve.loop.col(static_cast<Index>(i)) = plane.col(loop[i]);
  return curve;
}

}  // namespace velum::meshing
