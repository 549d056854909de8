// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/scene.hpp"
#include "velum/error.hpp"

namespace velum::scene {
namespace {

using Eigen::Vector3d;

// Steps of a full circle of `radius` whose chords stay within `error` of it.
Index circle_steps(double radius, double error) {
  const double half = std::acos(std::max(0.0, 1.0 - error / radius));
  return std::clamp<Index>(static_cast<Index>(std::ceil(std::numbers::pi / half)), 8, 720);
}

// Vertices of a (columns + 1) × (rows + 1) grid and its triangles, counter-clockwise where columns
// run to the right and rows up.
template <class At>
TriangleSet grid(Index columns, Index rows, const At& at) {
  TriangleSet set;
  set.vertices.resize(3, (columns + 1) * (rows + 1));
  for (Index j = 0; j <= rows; ++j)
    for (Index i = 0; i <= columns; ++i)
      set.vertices.col(j * (columns + 1) + i) =
          at(static_cast<double>(i) / static_cast<double>(columns),
             static_cast<double>(j) / static_cast<double>(rows));
  set.triangles.resize(3, 2 * columns * rows);
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i) {
      const auto a = static_cast<std::int32_t>(j * (columns + 1) + i);
      const auto c = static_cast<std::int32_t>(a + columns + 1);
      set.triangles.col(2 * (j * columns + i)) << a, a + 1, c + 1;
      set.triangles.col(2 * (j * columns + i) + 1) << a, c + 1, c;
    }
  return set;
}

TriangleSet triangles(const Plane& plane, double /*error*/) {
  if (!std::isfinite(plane.half_x))
    throw Error(Fault::graph, "an infinite plane has no mesh").hint("give it a size");
  return grid(1, 1, [&](double u, double v) -> Vector3d {
    return plane.pose * Vector3d((2 * u - 1) * plane.half_x, (2 * v - 1) * plane.half_y, 0.0);
  });
}

TriangleSet triangles(const Box& box, double /*error*/) {
  TriangleSet set;
  set.vertices.resize(3, 8);
  for (int i = 0; i < 8; ++i)
    set.vertices.col(i) =
        box.pose * box.half.cwiseProduct(Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  set.triangles.resize(3, 12);
  set.triangles << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
      3, 2, 5, 7, 1, 5, 7, 6, 4, 6, 3, 7,               //
      1, 3, 7, 6, 5, 4, 3, 7, 6, 2, 7, 5;
  return set;
}

TriangleSet triangles(const Ellipsoid& shape, double error) {
  const double longest = shape.semi_axes.maxCoeff();
  const Index around = circle_steps(longest, 0.5 * error);
  return grid(around, std::max<Index>(around / 2, 4), [&](double u, double v) -> Vector3d {
    const double turn = 2.0 * std::numbers::pi * u;
    const double rise = std::numbers::pi * (v - 0.5);
    return shape.pose *
           shape.semi_axes.cwiseProduct(Vector3d(std::cos(rise) * std::cos(turn),
                                                 std::cos(rise) * std::sin(turn), std::sin(rise)));
  });
}

TriangleSet triangles(const Cylinder& cylinder, double error) {
  const Vector3d axis = (cylinder.to - cylinder.from).normalized();
  const Vector3d x = axis.unitOrthogonal();
  const Vector3d y = axis.cross(x);
  // Rows: the centre and the rim of the lower end, then those of the upper.
  return grid(circle_steps(cylinder.radius, error), 3, [&](double u, double v) -> Vector3d {
    const double turn = 2.0 * std::numbers::pi * u;
    const double radius = v > 0.2 && v < 0.8 ? cylinder.radius : 0.0;
    return (v < 0.5 ? cylinder.from : cylinder.to) +
           radius * (std::cos(turn) * x + std::sin(turn) * y);
  });
}

TriangleSet triangles(const Cone& cone, double error) {
  const Vector3d axis = (cone.base - cone.apex).normalized();
  const Vector3d x = axis.unitOrthogonal();
  const Vector3d y = axis.cross(x);
  // Rows: the apex, the rim, and the centre of the base. Counter-clockwise seen from outside.
  return grid(circle_steps(cone.radius, error), 2, [&](double u, double v) -> Vector3d {
    const double turn = 2.0 * std::numbers::pi * u;
    const double radius = v > 0.2 && v < 0.8 ? cone.radius : 0.0;
    return (v < 0.2 ? cone.apex : cone.base) + radius * (std::cos(turn) * x + std::sin(turn) * y);
  });
}

TriangleSet triangles(const TriangleSet& set, double /*error*/) {
  return set;
}

TriangleSet triangles(const Sail& sail, double error) {
  Sail::Grid grid = sail.grid_within(error);
  return {std::move(grid.vertices), std::move(grid.triangles)};
}

// Without the flat triangles that a grid has where its rows shrink to a point.
void append(TriangleSet& all, const TriangleSet& more) {
  const Index vertices = all.vertices.cols();
  Index count = all.triangles.cols();
  all.vertices.conservativeResize(3, vertices + more.vertices.cols());
  all.vertices.rightCols(more.vertices.cols()) = more.vertices;
  all.triangles.conservativeResize(3, count + more.triangles.cols());
  for (Index i = 0; i < more.triangles.cols(); ++i) {
    const Vector3d a = more.vertices.col(more.triangles(0, i));
    const Vector3d b = more.vertices.col(more.triangles(1, i));
    const Vector3d c = more.vertices.col(more.triangles(2, i));
    if ((b - a).cross(c - a).norm() <= 1e-14) continue;
    all.triangles.col(count++) =
        more.triangles.col(i).array() + static_cast<std::int32_t>(vertices);
  }
  all.triangles.conservativeResize(3, count);
}

}  // namespace

TriangleSet triangulate(const Object& object, double error) {
  TriangleSet all;
  for (const Shape& shape : object.shapes)
    append(all, std::visit([&](const auto& own) { return triangles(own, error); }, shape));
  return all;
}

}  // namespace velum::scene
