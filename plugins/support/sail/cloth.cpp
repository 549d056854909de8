// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "sail/cloth.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace velum::sail {
namespace {

using Eigen::Matrix2Xd;
using Eigen::Matrix3Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr Index kGrid = 200;  // cells of the grid that a section is searched in, each way
constexpr Index kAreaRows = 400;
constexpr int kAreaPieces = 8;  // of a row, four Gauss points each

// Points from .. to of the outline.
Curve piece(const Outline& outline, Index from, Index to) {
  Matrix3Xd points(3, to - from + 1);
  for (Index i = from; i <= to; ++i)
    points.col(i - from) = outline.points.col(i % outline.points.cols());
  return Curve(std::move(points));
}

// Where a line of constant v crosses the loops, ascending.
std::vector<double> crossings(const std::vector<Matrix2Xd>& loops, double v) {
  std::vector<double> found;
  for (const Matrix2Xd& loop : loops)
    for (Index i = 0, j = loop.cols() - 1; i < loop.cols(); j = i++) {
      const Vector2d a = loop.col(i);
      const Vector2d b = loop.col(j);
      if ((a.y() > v) != (b.y() > v))
        found.push_back((b.x() - a.x()) * (v - a.y()) / (b.y() - a.y()) + a.x());
    }
  std::sort(found.begin(), found.end());
  return found;
}

// Integral of |du × dv| along u from a to b at v.
double strip(const bspline::Patch& patch, double a, double b, double v) {
  constexpr std::array<double, 4> kAt{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                      0.8611363115940526};
  constexpr std::array<double, 4> kWeight{0.3478548451374538, 0.6521451548625461,
                                          0.6521451548625461, 0.3478548451374538};
  const double half = 0.5 * (b - a) / kAreaPieces;
  double sum = 0.0;
  for (int piece = 0; piece < kAreaPieces; ++piece)
    for (std::size_t k = 0; k < kAt.size(); ++k) {
      const double u = a + half * (2 * piece + 1 + kAt[k]);
      const bspline::Derivatives d = patch.derivatives({u, v});
      sum += kWeight[k] * d.du.cross(d.dv).norm();
    }
  return half * sum;
}

// Place and depth of the deepest point of a section, on the parabola through it and the points some
// places before and after it.
Vector2d deepest_of(const std::vector<Vector2d>& points) {
  constexpr std::ptrdiff_t kBeside = 4;
  const auto most = std::max_element(
      points.begin(), points.end(),
      [](const Vector2d& a, const Vector2d& b) { return std::abs(a.y()) < std::abs(b.y()); });
  if (most - points.begin() < kBeside || points.end() - most <= kBeside) return *most;
  const Vector2d before = *(most - kBeside) - *most;
  const Vector2d after = *(most + kBeside) - *most;
  const double slope_before = before.y() / before.x();
  const double slope_after = after.y() / after.x();
  const double bend = (slope_after - slope_before) / (after.x() - before.x());
  const double slope = slope_before - bend * before.x();
  const double move = -0.5 * slope / bend;
  if (!(move > before.x() && move < after.x())) return *most;
  return *most + Vector2d(move, 0.5 * slope * move);
}

// Signed angle from a to b in the plane.
double angle_between(const Vector2d& a, const Vector2d& b) {
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

}  // namespace

Cloth::Cloth(const Surface& surface, const Vector3d& up, const Vector3d& bow, Context& context)
    : patch_(surface),
      frame_(make_frame(up, bow, surface.origin)),
      loops_(loops_of(patch_)),
      rim_(refined(patch_, loops_.front())),
      heights_(kGrid + 1, kGrid + 1) {
  Matrix3Xd polygon(3, rim_.cols());
  for (Index i = 0; i < rim_.cols(); ++i) polygon.col(i) = at(rim_.col(i));
  outline_ = sharpened(find_corners(polygon, median_edge(polygon)));
  Matrix2Xd sorted(2, rim_.cols());
  for (Index i = 0; i < rim_.cols(); ++i)
    sorted.col(i) = rim_.col(outline_.places[static_cast<std::size_t>(i)]);
  rim_ = std::move(sorted);
  const Vector2d step = (patch_.high() - patch_.low()) / static_cast<double>(kGrid);
  for (Index j = 0; j <= kGrid; ++j) {
    context.check();
    for (Index i = 0; i <= kGrid; ++i) {
      const Vector2d share(static_cast<double>(i), static_cast<double>(j));
      heights_(i, j) = at(patch_.low() + step.cwiseProduct(share)).z();
    }
  }
}

Border Cloth::border() const {
  Border border;
  border.luff = piece(outline_, 0, outline_.head);
  border.leech = piece(outline_, outline_.peak, outline_.clew).reversed();
  border.foot = piece(outline_, outline_.clew, outline_.points.cols()).reversed();
  border.top = piece(outline_, outline_.head, outline_.peak);
  return border;
}

// The place between a and b, which lie on either side of z, at height z.
Vector2d Cloth::root(Vector2d a, Vector2d b, double z) const {
  const bool rises = at(a).z() < z;
  for (int i = 0; i < 48; ++i) {
    const Vector2d middle = 0.5 * (a + b);
    ((at(middle).z() < z) == rises ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

// Where the outline from one point to another (forward or backward, around its end) first passes z.
std::optional<Cloth::End> Cloth::crossing(Index from, Index to, double z) const {
  const Index n = outline_.points.cols();
  const Index step = to >= from ? 1 : -1;
  for (Index i = from; i != to; i += step) {
    const Index a = i % n;
    const Index b = (i + step) % n;
    if ((outline_.points(2, a) < z) == (outline_.points(2, b) < z)) continue;
    const Vector2d uv = root(rim_.col(a), rim_.col(b), z);
    return End{uv, at(uv)};
  }
  return std::nullopt;
}

// Direction of the level curve through a place, in the plane of a section.
Vector2d Cloth::tangent(const Vector2d& uv) const {
  const bspline::Derivatives d = patch_.derivatives(uv);
  const Vector3d du = frame_.axes * d.du;
  const Vector3d dv = frame_.axes * d.dv;
  return (du * dv.z() - dv * du.z()).head<2>();
}

// Points of the section inside the border, on the lines of the grid.
std::vector<Vector2d> Cloth::cut(double z) const {
  const Vector2d step = (patch_.high() - patch_.low()) / static_cast<double>(kGrid);
  const auto place = [&](Index i, Index j) -> Vector2d {
    return patch_.low() +
           step.cwiseProduct(Vector2d(static_cast<double>(i), static_cast<double>(j)));
  };
  std::vector<Vector2d> found;
  const auto look = [&](Index i, Index j, Index k, Index l) {
    if ((heights_(i, j) < z) == (heights_(k, l) < z)) return;
    const Vector2d uv = root(place(i, j), place(k, l), z);
    if (bspline::inside(loops_, uv)) found.push_back(at(uv).head<2>());
  };
  for (Index j = 0; j <= kGrid; ++j)
    for (Index i = 0; i <= kGrid; ++i) {
      if (i < kGrid) look(i, j, i + 1, j);
      if (j < kGrid) look(i, j, i, j + 1);
    }
  return found;
}

RawSection Cloth::section(double z) const {
  const Index n = outline_.points.cols();
  // Above the head or the peak a section ends at the top, below tack or clew at the foot.
  auto luff = crossing(0, outline_.peak, z);
  auto leech = crossing(outline_.clew, outline_.head, z);
  if (!luff) luff = crossing(n, outline_.clew, z);
  if (!leech) leech = crossing(outline_.clew, n, z);
  if (!luff || !leech)
    throw Error(Fault::stage, "the border is not cut twice by the plane of a section")
        .hint("choose heights between 0 and 1");
  const Vector2d chord = (leech->at - luff->at).head<2>();
  const double square = chord.squaredNorm();
  // Share of the chord and offset from it over chord, ascending along the chord.
  std::vector<Vector2d> points{{0.0, 0.0}, {1.0, 0.0}};
  for (const Vector2d& p : cut(z)) {
    const Vector2d from = p - luff->at.head<2>();
    points.emplace_back(chord.dot(from) / square,
                        (chord.x() * from.y() - chord.y() * from.x()) / square);
  }
  std::sort(points.begin(), points.end(),
            [](const Vector2d& a, const Vector2d& b) { return a.x() < b.x(); });
  const Vector2d deepest = deepest_of(points);

  RawSection section;
  section.values.z = z;
  section.values.chord = std::sqrt(square);
  section.values.camber = std::abs(deepest.y());
  section.values.draft = deepest.x();
  section.values.angle = std::atan2(chord.y(), chord.x());
  const double sign = deepest.y() < 0.0 ? -1.0 : 1.0;
  const auto along = [&](const Vector2d& uv) -> Vector2d {
    const Vector2d t = tangent(uv);
    return t.dot(chord) < 0.0 ? Vector2d(-t) : t;
  };
  section.values.entry = sign * angle_between(chord, along(luff->uv));
  section.values.exit = sign * angle_between(along(leech->uv), chord);
  section.bulge = deepest.y();
  return section;
}

double Cloth::area(Context& context) const {
  const double low = loops_.front().row(1).minCoeff();
  const double step = (loops_.front().row(1).maxCoeff() - low) / static_cast<double>(kAreaRows);
  double sum = 0.0;
  for (Index row = 0; row < kAreaRows; ++row) {
    context.check();
    const double v = low + (static_cast<double>(row) + 0.5) * step;
    const std::vector<double> ends = crossings(loops_, v);
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2)
      sum += strip(patch_, ends[i], ends[i + 1], v);
  }
  return step * sum;
}

}  // namespace velum::sail
