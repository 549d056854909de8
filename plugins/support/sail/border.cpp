// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "sail/border.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace velum::sail {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr Index kFewest = 4;

// Points of the edge whose place lies from `begin` to `end` along the outline, at least `margin`
// off both, as a smooth curve.
Curve side(const EdgePoints& edge, double begin, double end, double margin,
           const std::string& name) {
  std::vector<Index> chosen;
  for (const double less : {margin, 0.0}) {
    chosen.clear();
    for (Index i = 0; i < edge.arc.size(); ++i)
      if (edge.arc[i] >= begin + less && edge.arc[i] <= end - less) chosen.push_back(i);
    if (static_cast<Index>(chosen.size()) >= 2 * kFewest) break;
  }
  if (static_cast<Index>(chosen.size()) < kFewest)
    throw Error(Fault::stage, "the " + name + " has only " + std::to_string(chosen.size()) +
                                  " border points, at least 4 are needed")
        .hint("use a finer scan, or check 'up' and 'bow'");
  std::stable_sort(chosen.begin(), chosen.end(),
                   [&](Index a, Index b) { return edge.arc[a] < edge.arc[b]; });
  const auto n = static_cast<Index>(chosen.size());
  Matrix3Xd points(3, n);
  VectorXd share(n);
  VectorXd weights(n);
  const double first = edge.arc[chosen.front()];
  const double span = std::max(edge.arc[chosen.back()] - first, 1e-12);
  for (Index i = 0; i < n; ++i) {
    const Index from = chosen[static_cast<std::size_t>(i)];
    points.col(i) = edge.points.col(from);
    share[i] = (edge.arc[from] - first) / span;
    weights[i] = std::max(edge.weights[from], 1e-6);
  }
  return smooth_curve(points, share, weights);
}

// An end of a curve, and the way out of it.
struct End {
  Vector3d at;
  Vector3d out;
};
End start_of(const Curve& curve) {
  return {curve.front(), -curve.start_direction()};
}
End end_of(const Curve& curve) {
  return {curve.back(), curve.end_direction()};
}

// Where two ends, lengthened, come nearest to each other; half-way between them where they run
// nearly side by side, or meet farther than `reach` from them.
Vector3d meeting(const End& a, const End& b, double reach) {
  const Vector3d gap = b.at - a.at;
  const Vector3d middle = a.at + 0.5 * gap;
  const double cosine = a.out.dot(b.out);
  const double square = 1.0 - cosine * cosine;
  if (square < 0.07) return middle;  // within 15 degrees
  const double s = (gap.dot(a.out) - cosine * gap.dot(b.out)) / square;
  const double t = (cosine * gap.dot(a.out) - gap.dot(b.out)) / square;
  if (std::max(std::abs(s), std::abs(t)) > reach) return middle;
  return 0.5 * (a.at + s * a.out + b.at + t * b.out);
}

// The curve, cut or lengthened upward to height z.
Curve up_to(const Curve& curve, double z) {
  if (curve.back().z() >= z) {
    const auto end = curve.at_height(z);
    if (end) return curve.ending_at(*end);
  }
  const Vector3d direction = curve.end_direction();
  const double rise = std::max(direction.z(), 0.3);  // a nearly level end is not followed far
  return curve.ending_at(curve.back() + direction * ((z - curve.back().z()) / rise));
}

// Height of the top of a sail that has no top edge to speak of: that of the points moved upward
// there.
double level_of_top(const EdgePoints& edge, const Outline& outline) {
  double sum = 0.0;
  int count = 0;
  for (Index i = 0; i < edge.arc.size(); ++i) {
    const bool there = edge.arc[i] >= outline.arc[outline.head] - edge.step &&
                       edge.arc[i] <= outline.arc[outline.peak] + edge.step;
    if (!there || !(edge.moves(2, i) > 0.7 * edge.moves.col(i).norm())) continue;
    sum += edge.points(2, i);
    ++count;
  }
  const double highest = outline.points.row(2).maxCoeff();
  return count > 0 ? std::max(sum / count, highest) : highest;
}

}  // namespace

EdgePoints edge_as_is(const Outline& outline) {
  const Index n = outline.points.cols();
  EdgePoints edge{outline.points, outline.arc, VectorXd(n), Matrix3Xd::Zero(3, n), 0.0};
  for (Index i = 0; i < n; ++i) {
    const Index before = (i + n - 1) % n;
    const Index after = (i + 1) % n;
    edge.weights[i] = 0.5 * ((outline.points.col(i) - outline.points.col(before)).norm() +
                             (outline.points.col(after) - outline.points.col(i)).norm());
  }
  return edge;
}

Border make_border(const Outline& outline, const EdgePoints& edge) {
  // Points at the corners themselves belong to both sides, or, moved outward, to none.
  const double margin = 0.5 * edge.step;
  const double reach = edge.step > 0.0 ? 5.0 * edge.step : 2.5 * outline.spacing;
  const double head = outline.arc[outline.head];
  const double peak = outline.arc[outline.peak];
  const double clew = outline.arc[outline.clew];
  Border border;
  border.luff = side(edge, 0.0, head, margin, "luff");
  border.leech = side(edge, peak, clew, margin, "leech").reversed();
  border.foot = side(edge, clew, outline.length, margin, "foot").reversed();

  const Vector3d tack_at = meeting(start_of(border.luff), start_of(border.foot), reach);
  const Vector3d clew_at = meeting(start_of(border.leech), end_of(border.foot), reach);
  border.luff = border.luff.starting_at(tack_at);
  border.leech = border.leech.starting_at(clew_at);
  border.foot = border.foot.starting_at(tack_at).ending_at(clew_at);

  if (outline.has_top) {
    border.top = side(edge, head, peak, margin, "top edge");
    const Vector3d head_at = meeting(end_of(border.luff), start_of(border.top), reach);
    const Vector3d peak_at = meeting(end_of(border.leech), end_of(border.top), reach);
    border.luff = border.luff.ending_at(head_at);
    border.leech = border.leech.ending_at(peak_at);
    border.top = border.top.starting_at(head_at).ending_at(peak_at);
    return border;
  }
  const double level = level_of_top(edge, outline);
  border.luff = up_to(border.luff, level);
  border.leech = up_to(border.leech, level);
  Matrix3Xd top(3, 2);
  top << border.head(), border.peak();
  border.top = Curve(std::move(top));
  return border;
}

double strip_area(const Sheet& sheet, const Outline& outline, const Border& border) {
  const auto curve_of = [&](Index i) -> const Curve& {
    if (i <= outline.head) return border.luff;
    if (i < outline.peak) return border.top;
    return i < outline.clew ? border.leech : border.foot;
  };
  const Vector3d centre = sheet.points.rowwise().mean();
  const Index n = outline.points.cols();
  double sum = 0.0;
  for (Index i = 0; i < n; ++i) {
    // The triangle between an edge of the outline and the curve, seen along the local normal.
    const Vector3d a = outline.points.col(i);
    const Vector3d b = outline.points.col((i + 1) % n);
    const Curve& curve = curve_of(i);
    const Vector3d middle = 0.5 * (a + b);
    const double at = curve.nearest(middle) * static_cast<double>(curve.points().cols() - 1);
    const auto k = std::min(static_cast<Index>(at), curve.points().cols() - 2);
    const Vector3d from = curve.points().col(k);
    const Vector3d step = curve.points().col(k + 1) - from;
    if (step.norm() < 1e-12) continue;
    const Vector3d along = step.normalized();
    const Vector3d gap = from + (at - static_cast<double>(k)) * step - middle;
    const Vector3d away = middle - centre;
    const Vector3d outward = (away - away.dot(along) * along).normalized();
    sum += std::copysign(gap.norm(), gap.dot(outward)) * std::abs((b - a).dot(along));
  }
  return sum;
}

}  // namespace velum::sail
