// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "bspline/tessellate.hpp"

#include <algorithm>
#include <cmath>

#include "bspline/flatten.hpp"
#include "cgal/constrained_2.hpp"

namespace velum::bspline {
namespace {

using Eigen::Matrix2Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMostVertices = 4e6;
// Inner vertices nearer to the border than this share of the size would make slivers there.
constexpr double kClear = 0.6;

std::vector<Matrix2Xd> loops_of(const Patch& patch) {
  const Vector2d low = patch.low();
  const Vector2d high = patch.high();
  if (patch.surface().trimming.empty()) {
    Matrix2Xd rectangle(2, 4);
    rectangle << low.x(), high.x(), high.x(), low.x(), low.y(), low.y(), high.y(), high.y();
    return {rectangle};
  }
  const Vector2d slack = 1e-9 * (high - low);
  for (const Matrix2Xd& loop : patch.surface().trimming)
    if (!((loop.rowwise().minCoeff() - low + slack).minCoeff() >= 0.0) ||
        !((high + slack - loop.rowwise().maxCoeff()).minCoeff() >= 0.0))
      throw Error(Fault::stage, "a trimming loop leaves the surface's range of parameters");
  return patch.surface().trimming;
}

// Points on the way from a to b in (u, v), a included and b not, at equal distances on the surface
// of at most `size`.
void subdivide(const Patch& patch, const Vector2d& a, const Vector2d& b, double size,
               std::vector<Vector2d>& out) {
  constexpr int kSteps = 16;
  std::array<double, kSteps + 1> arc{};
  Vector3d last = patch.at(a);
  for (int i = 1; i <= kSteps; ++i) {
    const Vector3d here = patch.at(a + (b - a) * (static_cast<double>(i) / kSteps));
    arc[static_cast<std::size_t>(i)] = arc[static_cast<std::size_t>(i - 1)] + (here - last).norm();
    last = here;
  }
  const double length = arc.back();
  if (!(length / size < kMostVertices))
    throw Error(Fault::stage, "the border needs more than four million vertices")
        .hint("choose a coarser mesh");
  const auto parts = std::max<Index>(1, static_cast<Index>(std::ceil(length / size - 1e-6)));
  std::size_t step = 1;
  for (Index i = 0; i < parts; ++i) {
    const double wanted = length * static_cast<double>(i) / static_cast<double>(parts);
    while (step < kSteps && arc[step] < wanted) ++step;
    const double span = arc[step] - arc[step - 1];
    const double share = span > 0.0 ? std::max(0.0, (wanted - arc[step - 1]) / span) : 0.0;
    out.emplace_back(a + (b - a) * ((static_cast<double>(step - 1) + share) / kSteps));
  }
  out[out.size() - static_cast<std::size_t>(parts)] = a;
}

struct Vertices {
  std::vector<Vector2d> places;
  std::vector<std::vector<std::int32_t>> loops;
};

// The border's vertices; neighbours that coincide on the surface become one.
Vertices border_of(const Patch& patch, const std::vector<Matrix2Xd>& loops, double size,
                   Context& context) {
  Vertices border;
  for (const Matrix2Xd& loop : loops) {
    std::vector<Vector2d> points;
    for (Index i = 0; i < loop.cols(); ++i) {
      if (i % 256 == 0) context.check();
      subdivide(patch, loop.col(i), loop.col((i + 1) % loop.cols()), size, points);
    }
    const double same = 1e-9 * size;
    const auto apart = [&](const Vector2d& a, const Vector2d& b) {
      return (patch.at(a) - patch.at(b)).norm() > same;
    };
    auto& numbers = border.loops.emplace_back();
    const std::size_t first = border.places.size();
    for (const Vector2d& point : points) {
      if (!numbers.empty() && !apart(border.places.back(), point)) continue;
      numbers.push_back(static_cast<std::int32_t>(border.places.size()));
      border.places.push_back(point);
    }
    while (numbers.size() > 1 && !apart(border.places.back(), border.places[first])) {
      numbers.pop_back();
      border.places.pop_back();
    }
    if (numbers.size() < 3) throw Error(Fault::stage, "a border of the surface encloses no area");
  }
  return border;
}

// Where the line of constant v crosses the loops, ascending.
std::vector<double> crossings(const std::vector<Matrix2Xd>& loops, double v) {
  std::vector<double> found;
  for (const Matrix2Xd& loop : loops)
    for (Index i = 0, j = loop.cols() - 1; i < loop.cols(); j = i++) {
      const Vector2d a = loop.col(i);
      const Vector2d b = loop.col(j);
      if ((a.y() > v) == (b.y() > v)) continue;
      found.push_back((b.x() - a.x()) * (v - a.y()) / (b.y() - a.y()) + a.x());
    }
  std::sort(found.begin(), found.end());
  return found;
}

// Places in rows, every other one shifted by half a step, inside the loops.
std::vector<Vector2d> inner_places(const Flat& flat, const std::vector<Matrix2Xd>& loops,
                                   double size, Context& context) {
  std::vector<Vector2d> places;
  const double rise = 0.5 * std::sqrt(3.0) * size;
  const double rows = flat.height() / rise;
  if (!(rows < kMostVertices))
    throw Error(Fault::stage, "the mesh needs more than four million vertices")
        .hint("choose a coarser mesh");
  for (Index r = 0; static_cast<double>(r) < rows; ++r) {
    context.check();
    const Flat::Row row = flat.row_at(rise * (static_cast<double>(r) + 0.5));
    const std::vector<double> cuts = crossings(loops, row.v);
    const double shift = r % 2 == 0 ? 0.0 : 0.5;
    const double first = std::ceil(row.left / size - shift);
    const double last = std::floor(row.right / size - shift);
    if (static_cast<double>(places.size()) + last - first > kMostVertices)
      throw Error(Fault::stage, "the mesh needs more than four million vertices")
          .hint("choose a coarser mesh");
    for (double k = first; k <= last; k += 1.0) {
      const double u = flat.u_at((k + shift) * size, row.v);
      const auto below = std::lower_bound(cuts.begin(), cuts.end(), u) - cuts.begin();
      if (below % 2 == 1) places.emplace_back(u, row.v);
    }
  }
  return places;
}

// Positions on the surface, in parallel.
Points positions_of(const Patch& patch, const std::vector<Vector2d>& places, Context& context) {
  Points points(3, static_cast<Index>(places.size()));
  parallel_for(context, points.cols(), 2048, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i)
      points.col(i) = patch.at(places[static_cast<std::size_t>(i)]).cast<float>();
  });
  return points;
}

// The border's vertices and the middles of its edges, to keep inner vertices clear of them.
Points border_samples(const Patch& patch, const Vertices& border, Context& context) {
  std::vector<Vector2d> samples = border.places;
  for (const auto& loop : border.loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto a = static_cast<std::size_t>(loop[i]);
      const auto b = static_cast<std::size_t>(loop[(i + 1) % loop.size()]);
      samples.emplace_back(0.5 * (border.places[a] + border.places[b]));
    }
  return positions_of(patch, samples, context);
}

void add_inner(const Patch& patch, const std::vector<Vector2d>& inner, double size,
               Vertices& vertices, Context& context) {
  const Points samples = border_samples(patch, vertices, context);
  const Neighbours border(ConstPoints(samples.data(), 3, samples.cols()));
  const Points at = positions_of(patch, inner, context);
  std::vector<std::uint8_t> keep(inner.size());
  parallel_for(context, at.cols(), 2048, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i)
      keep[static_cast<std::size_t>(i)] =
          border.nearest_one(at.col(i), kClear * size).index < 0 ? 1 : 0;
  });
  for (std::size_t i = 0; i < inner.size(); ++i)
    if (keep[i] != 0) vertices.places.push_back(inner[i]);
}

}  // namespace

Tessellation tessellate(const Surface& surface, double size, Context& context) {
  if (!(size > 0.0)) throw Error(Fault::stage, "the edge length of a mesh is above 0");
  const Patch patch(surface);
  const std::vector<Matrix2Xd> loops = loops_of(patch);
  const Flat flat(patch);
  Vertices vertices = border_of(patch, loops, size, context);
  add_inner(patch, inner_places(flat, loops, size, context), size, vertices, context);

  const auto count = static_cast<Index>(vertices.places.size());
  Tessellation made;
  made.parameters.resize(2, count);
  Matrix2Xd plane(2, count);
  for (Index i = 0; i < count; ++i) {
    made.parameters.col(i) = vertices.places[static_cast<std::size_t>(i)];
    plane.col(i) = flat.to_plane(made.parameters.col(i));
  }
  context.check();
  const auto triangles = cgal::constrained_delaunay_2(plane, vertices.loops);
  context.check();
  Triangles columns(3, static_cast<Index>(triangles.size()));
  for (Index i = 0; i < columns.cols(); ++i)
    for (Index k = 0; k < 3; ++k)
      columns(k, i) = triangles[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
  Cloud cloud(positions_of(patch, vertices.places, context), surface.origin);
  made.mesh = Mesh(cloud.with_sensors(surface.sensors), std::move(columns));
  return made;
}

Matrix2Xd simplified(const Surface& surface, const Matrix2Xd& loop, double tolerance,
                     const std::vector<Index>& keep) {
  const Patch patch(surface);
  const Index n = loop.cols();
  Eigen::Matrix3Xd points(3, n);
  for (Index i = 0; i < n; ++i) points.col(i) = patch.at(loop.col(i));
  std::vector<Index> fixed = keep;
  if (fixed.empty()) fixed.push_back(0);
  // Thirds, so that never fewer than three are left.
  for (Index k = 1; fixed.size() < 3 && k < 4; ++k) {
    const Index third = (fixed.front() + k * n / 3 - k / 3) % n;
    if (std::find(fixed.begin(), fixed.end(), third) == fixed.end()) fixed.push_back(third);
  }
  std::sort(fixed.begin(), fixed.end());
  std::vector<std::uint8_t> kept(static_cast<std::size_t>(n), 0);
  std::vector<std::pair<Index, Index>> stretches;
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    kept[static_cast<std::size_t>(fixed[i])] = 1;
    stretches.emplace_back(fixed[i], i + 1 < fixed.size() ? fixed[i + 1] : fixed[0] + n);
  }
  while (!stretches.empty()) {
    const auto [from, to] = stretches.back();
    stretches.pop_back();
    const Vector3d a = points.col(from % n);
    const Vector3d edge = points.col(to % n) - a;
    const double square = edge.squaredNorm();
    double most = tolerance;
    Index at = -1;
    for (Index i = from + 1; i < to; ++i) {
      const Vector3d p = points.col(i % n) - a;
      const double s = square > 0.0 ? std::clamp(p.dot(edge) / square, 0.0, 1.0) : 0.0;
      const double off = (p - s * edge).norm();
      if (off <= most) continue;
      most = off;
      at = i;
    }
    if (at < 0) continue;
    kept[static_cast<std::size_t>(at % n)] = 1;
    stretches.emplace_back(from, at);
    stretches.emplace_back(at, to);
  }
  Matrix2Xd left(2, std::count(kept.begin(), kept.end(), 1));
  for (Index i = 0, k = 0; i < n; ++i)
    if (kept[static_cast<std::size_t>(i)] != 0) left.col(k++) = loop.col(i);
  return left;
}

}  // namespace velum::bspline
