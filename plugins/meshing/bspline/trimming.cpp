// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "trimming.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "sail/border.hpp"
#include "sail/lattice.hpp"

namespace velum::meshing {
namespace {

using Eigen::Matrix2Xd;
using Eigen::Matrix3Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kReach = 6;         // cells inward to the next return
constexpr double kInside = 0.75;  // scan steps inside the curve from which on a return counts less
constexpr int kRounds = 5;

// The unrolled plane as a flat sail: x aft, z up.
Matrix3Xd upright(const Matrix2Xd& plane) {
  Matrix3Xd points = Matrix3Xd::Zero(3, plane.cols());
  points.row(0) = plane.row(0);
  points.row(2) = plane.row(1);
  return points;
}

// The edge's points next to the outline, each half a scan step beyond a last return.
class ScanEdge {
 public:
  ScanEdge(const Cloud& cloud, const FittedSheet& sheet)
      : lattice_(cloud), patch_(sheet.surface), sheet_(sheet) {
    for (std::size_t i = 0; i < cloud.sensors().size(); ++i)
      eyes_.emplace_back(cloud.sensor_position(i).cast<double>());
  }

  sail::EdgePoints find(const PointOutline& outline, const Matrix2Xd& plane) {
    for (const std::int32_t vertex : outline.near) {
      const sail::Cell cell = lattice_.cell(vertex);
      if (cell.sensor >= eyes_.size()) continue;
      for (const bool lines : {false, true})
        for (const int sign : {-1, 1}) add(vertex, cell, lines, sign, plane);
    }
    sail::EdgePoints edge;
    const auto n = static_cast<Index>(places_.size());
    edge.points = Matrix3Xd::Zero(3, n);
    edge.moves = Matrix3Xd::Zero(3, n);
    edge.weights = VectorXd::Ones(n);
    edge.arc.resize(n);
    for (Index i = 0; i < n; ++i) {
      const Vector2d place = places_[static_cast<std::size_t>(i)];
      const Vector2d move = moves_[static_cast<std::size_t>(i)];
      edge.points.col(i) << place.x(), 0.0, place.y();
      edge.moves.col(i) << move.x(), 0.0, move.y();
    }
    return edge;
  }

 private:
  void add(std::int32_t vertex, const sail::Cell& cell, bool lines, int sign,
           const Matrix2Xd& plane) {
    if (!lattice_.ends_at(cell, lines, sign)) return;
    const sail::Lattice::Inner inner = lattice_.inner(cell, lines, sign, kReach);
    if (inner.vertex < 0) return;
    // On the surface, where noise along the rays does not matter.
    const Vector2d uv = sheet_.uv.col(vertex);
    const bspline::Derivatives d = patch_.derivatives(uv);
    const auto at =
        sail::half_step_on(eyes_[cell.sensor], d.point, patch_.at(sheet_.uv.col(inner.vertex)),
                           inner.steps, d.normal());
    if (!at) return;
    Eigen::Matrix<double, 3, 2> slopes;
    slopes << d.du, d.dv;
    const Vector2d step =
        (slopes.transpose() * slopes).ldlt().solve(slopes.transpose() * (*at - d.point));
    const Vector2d place = sheet_.frame.to_plane(uv + step);
    if (!place.allFinite()) return;
    places_.push_back(place);
    moves_.emplace_back(place - plane.col(vertex));
  }

  sail::Lattice lattice_;
  bspline::Patch patch_;
  const FittedSheet& sheet_;
  std::vector<Vector3d> eyes_;
  std::vector<Vector2d> places_;
  std::vector<Vector2d> moves_;
};

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

// Where segments a b and c d cross, the share of the way from a to b.
std::optional<double> crossing(const Vector2d& a, const Vector2d& b, const Vector2d& c,
                               const Vector2d& d) {
  const Vector2d r = b - a;
  const Vector2d s = d - c;
  const double cross = r.x() * s.y() - r.y() * s.x();
  if (std::abs(cross) < 1e-300) return std::nullopt;
  const Vector2d gap = c - a;
  const double t = (gap.x() * s.y() - gap.y() * s.x()) / cross;
  const double w = (gap.x() * r.y() - gap.y() * r.x()) / cross;
  if (t < 0.0 || t > 1.0 || w < 0.0 || w > 1.0) return std::nullopt;
  return t;
}

// Where a polygon crosses itself, as luff and leech do above a pointed head, the shorter part is
// cut off. True when there was such a place.
bool cut_crossing(std::vector<Vector2d>& points) {
  const std::size_t n = points.size();
  for (std::size_t i = 0; i + 2 < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j + 1 == n) continue;
      const auto t = crossing(points[i], points[i + 1], points[j], points[(j + 1) % n]);
      if (!t) continue;
      const Vector2d at = points[i] + *t * (points[i + 1] - points[i]);
      const auto begin = points.begin();
      const auto from = static_cast<std::ptrdiff_t>(i + 1);
      const auto to = static_cast<std::ptrdiff_t>(j + 1);
      std::vector<Vector2d> left{at};
      if (2 * (j - i) < n) {
        left.insert(left.end(), begin + to, points.end());
        left.insert(left.end(), begin, begin + from);
      } else {
        left.insert(left.end(), begin + from, begin + to);
      }
      points = std::move(left);
      return true;
    }
  return false;
}

// The curves as one closed loop, counter-clockwise: foot, leech, top, luff downward.
TrimmingCurve closed(const sail::Border& border) {
  std::vector<Vector2d> points;
  TrimmingCurve curve;
  for (const sail::Curve& side :
       {border.foot, border.leech, border.top.reversed(), border.luff.reversed()}) {
    const double least = 1e-7 * side.length() + 1e-300;
    curve.corners.push_back(static_cast<Index>(points.size()));
    for (Index i = 0; i + 1 < side.points().cols(); ++i) {
      const Vector2d p(side.points()(0, i), side.points()(2, i));
      if (points.empty() || (p - points.back()).norm() > least) points.push_back(p);
    }
  }
  std::vector<Vector2d> corners;
  for (const Index corner : curve.corners)
    corners.push_back(points[std::min(static_cast<std::size_t>(corner), points.size() - 1)]);
  while (points.size() > 4 && cut_crossing(points)) {
  }
  const auto n = static_cast<Index>(points.size());
  curve.loop.resize(2, n);
  for (Index i = 0; i < n; ++i) curve.loop.col(i) = points[static_cast<std::size_t>(i)];
  for (std::size_t k = 0; k < corners.size(); ++k)
    (curve.loop.colwise() - corners[k]).colwise().squaredNorm().minCoeff(&curve.corners[k]);
  return curve;
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
    edge = ScanEdge(cloud, sheet).find(found, plane);
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
