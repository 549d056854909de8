// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "shapes/fit.hpp"

#include <Eigen/Dense>
#include <numbers>

#include "geometry/plane_fit.hpp"

namespace velum::shapes {
namespace {

using Eigen::Vector3d;
using Row = Eigen::Matrix<double, 6, 1>;

constexpr Index kGrain = 4096;

std::optional<Shape> plane(const Sample& s) {
  const Vector3d a = s.points[1] - s.points[0];
  const Vector3d b = s.points[2] - s.points[0];
  const Vector3d across = a.cross(b);
  if (!(across.norm() > 1e-3 * a.norm() * b.norm())) return std::nullopt;
  return Shape{.kind = Kind::plane, .point = s.points[0], .axis = across.normalized()};
}

// The lines p + t n of two points: parameters where they come nearest to each other.
std::optional<Eigen::Vector2d> nearest_of_lines(const Vector3d& p, const Vector3d& n,
                                                const Vector3d& q, const Vector3d& m) {
  const double c = n.dot(m);
  const double d = 1.0 - c * c;
  if (!(d > 1e-4)) return std::nullopt;  // within half a degree of parallel
  const Vector3d w = q - p;
  const double along_n = w.dot(n);
  const double along_m = w.dot(m);
  return Eigen::Vector2d((along_n - c * along_m) / d, (c * along_n - along_m) / d);
}

std::optional<Shape> sphere(const Sample& s) {
  const auto t = nearest_of_lines(s.points[0], s.normals[0], s.points[1], s.normals[1]);
  if (!t) return std::nullopt;
  const Vector3d centre =
      0.5 * (s.points[0] + (*t)[0] * s.normals[0] + s.points[1] + (*t)[1] * s.normals[1]);
  const double radius = 0.5 * ((s.points[0] - centre).norm() + (s.points[1] - centre).norm());
  return Shape{.kind = Kind::sphere, .point = centre, .radius = radius};
}

std::optional<Shape> cylinder(const Sample& s) {
  const Vector3d across = s.normals[0].cross(s.normals[1]);
  if (!(across.norm() > 0.01)) return std::nullopt;
  const Vector3d axis = across.normalized();
  const auto flat = [&](const Vector3d& v) -> Vector3d { return v - v.dot(axis) * axis; };
  const Vector3d p = flat(s.points[0]);
  const Vector3d q = flat(s.points[1]);
  const auto t = nearest_of_lines(p, s.normals[0], q, s.normals[1]);
  if (!t) return std::nullopt;
  const Vector3d centre = 0.5 * (p + (*t)[0] * s.normals[0] + q + (*t)[1] * s.normals[1]);
  const Vector3d point = centre + s.points[0].dot(axis) * axis;
  const double radius = 0.5 * ((p - flat(centre)).norm() + (q - flat(centre)).norm());
  return Shape{.kind = Kind::cylinder, .point = point, .axis = axis, .radius = radius};
}

std::optional<Shape> cone(const Sample& s) {
  Eigen::Matrix3d planes;
  Vector3d offsets;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    planes.row(i) = s.normals[k];
    offsets[i] = s.normals[k].dot(s.points[k] - s.points[0]);
  }
  if (!(std::abs(planes.determinant()) > 1e-4)) return std::nullopt;
  const Vector3d apex = s.points[0] + planes.inverse() * offsets;
  std::array<Vector3d, 3> rays;
  for (std::size_t i = 0; i < 3; ++i) rays[i] = (s.points[i] - apex).normalized();
  Vector3d axis = (rays[1] - rays[0]).cross(rays[2] - rays[0]);
  if (!(axis.norm() > 1e-6)) return std::nullopt;
  axis.normalize();
  if (axis.dot(rays[0] + rays[1] + rays[2]) < 0.0) axis = -axis;
  double angle = 0.0;
  for (const Vector3d& ray : rays) angle += std::acos(std::clamp(ray.dot(axis), -1.0, 1.0)) / 3.0;
  return Shape{.kind = Kind::cone, .point = apex, .axis = axis, .angle = angle};
}

// A shape moved by small changes: 0 to 2 of its point along x, y and the axis, 3 and 4 of the axis
// towards x and y, 5 of the radius or the angle.
struct Frame {
  explicit Frame(const Shape& shape) : x(shape.axis.unitOrthogonal()), y(shape.axis.cross(x)) {}
  Vector3d x;
  Vector3d y;
};

Shape moved(const Shape& shape, const Frame& frame, const Row& by) {
  Shape made = shape;
  made.point += by[0] * frame.x + by[1] * frame.y + by[2] * shape.axis;
  made.axis = (shape.axis + by[3] * frame.x + by[4] * frame.y).normalized();
  (shape.kind == Kind::cone ? made.angle : made.radius) += by[5];
  return made;
}

// Distance of a point and its derivative by each change; those that a kind does not have are zero.
double linearised(const Shape& shape, const Frame& frame, const Vector3d& p, Row& row) {
  const Vector3d q = p - shape.point;
  const double along = q.dot(shape.axis);
  const Vector3d across = q - along * shape.axis;
  const double away = across.norm();
  row.setZero();
  if (shape.kind == Kind::sphere) {
    const double length = q.norm();
    if (length > 0.0) row.head<3>() << -q.dot(frame.x), -q.dot(frame.y), -along;
    if (length > 0.0) row.head<3>() /= length;
    row[5] = -1.0;
    return length - shape.radius;
  }
  if (!(away > 0.0)) return shape.distance(p);
  const double x = across.dot(frame.x) / away;
  const double y = across.dot(frame.y) / away;
  if (shape.kind == Kind::cylinder) {
    row << -x, -y, 0.0, -along * x, -along * y, -1.0;
    return away - shape.radius;
  }
  const double sine = std::sin(shape.angle);
  const double cosine = std::cos(shape.angle);
  if (along * cosine + away * sine < 0.0) return q.norm();  // nearest to the apex
  const double slant = along * cosine + away * sine;
  row << -x * cosine, -y * cosine, sine, -x * slant, -y * slant, -slant;
  return away * cosine - along * sine;
}

struct Normal {
  Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
  Row right = Row::Zero();
  double squares = 0.0;
};

Normal assemble(const Shape& shape, const Points& positions, std::span<const std::int32_t> members,
                Context& context) {
  const Frame frame(shape);
  return parallel_reduce(
      context, static_cast<Index>(members.size()), kGrain, Normal{},
      [&](Index begin, Index end) {
        Normal part;
        Row row;
        for (Index i = begin; i < end; ++i) {
          const auto member = members[static_cast<std::size_t>(i)];
          const double d = linearised(shape, frame, positions.col(member).cast<double>(), row);
          part.matrix.noalias() += row * row.transpose();
          part.right -= d * row;
          part.squares += d * d;
        }
        return part;
      },
      [](Normal& total, const Normal& part) {
        total.matrix += part.matrix;
        total.right += part.right;
        total.squares += part.squares;
      });
}

double squares(const Shape& shape, const Points& positions, std::span<const std::int32_t> members,
               Context& context) {
  return parallel_reduce(
      context, static_cast<Index>(members.size()), kGrain, 0.0,
      [&](Index begin, Index end) {
        double sum = 0.0;
        for (Index i = begin; i < end; ++i) {
          const double d =
              shape.distance(positions.col(members[static_cast<std::size_t>(i)]).cast<double>());
          sum += d * d;
        }
        return sum;
      },
      [](double& total, double part) { total += part; });
}

Shape refined_plane(const Shape& start, const Points& positions,
                    std::span<const std::int32_t> members, Context& context) {
  const geometry::PointMoments none(positions.col(members.front()).cast<double>());
  const auto moments = parallel_reduce(
      context, static_cast<Index>(members.size()), kGrain, none,
      [&](Index begin, Index end) {
        geometry::PointMoments part = none;
        for (Index i = begin; i < end; ++i)
          part.add(positions.col(members[static_cast<std::size_t>(i)]).cast<double>());
        return part;
      },
      [](geometry::PointMoments& total, const geometry::PointMoments& part) { total.add(part); });
  const geometry::PlaneFit fit = moments.plane();
  if (!(fit.spread[1] > 1e-6 * fit.spread[2])) return start;  // on a line
  Shape made = start;
  made.point = fit.centroid;
  made.axis = fit.normal.dot(start.axis) < 0.0 ? Vector3d(-fit.normal) : fit.normal;
  return made;
}

bool sound(const Shape& shape) {
  if (!shape.point.allFinite() || !shape.axis.allFinite()) return false;
  if (shape.kind == Kind::cone) return shape.angle > 0.0 && shape.angle < std::numbers::pi / 2;
  return shape.radius > 0.0;
}

}  // namespace

std::optional<Shape> through(Kind kind, const Sample& sample) {
  switch (kind) {
    case Kind::sphere:
      return sphere(sample);
    case Kind::cylinder:
      return cylinder(sample);
    case Kind::cone:
      return cone(sample);
    default:
      return plane(sample);
  }
}

Shape refine(const Shape& start, const Points& positions, std::span<const std::int32_t> members,
             Context& context) {
  if (members.size() < 6) return start;
  if (start.kind == Kind::plane) return refined_plane(start, positions, members, context);
  Shape best = start;
  double damping = 1e-3;
  Normal normal = assemble(best, positions, members, context);
  for (int step = 0; step < 20; ++step) {
    Eigen::Matrix<double, 6, 6> matrix = normal.matrix;
    for (int i = 0; i < 6; ++i)
      matrix(i, i) = matrix(i, i) > 0.0 ? matrix(i, i) * (1.0 + damping) : 1.0;
    const Shape trial = moved(best, Frame(best), matrix.ldlt().solve(normal.right));
    const double error =
        sound(trial) ? squares(trial, positions, members, context) : normal.squares;
    if (!(error < normal.squares)) {
      damping *= 10.0;
      if (damping > 1e6) break;
      continue;
    }
    const bool done = error > normal.squares * (1.0 - 1e-6);
    best = trial;
    if (done) break;
    damping = std::max(damping * 0.1, 1e-9);
    normal = assemble(best, positions, members, context);
  }
  return best;
}

double rms(const Shape& shape, const Points& positions, std::span<const std::int32_t> members,
           Context& context) {
  if (members.empty()) return 0.0;
  return std::sqrt(squares(shape, positions, members, context) /
                   static_cast<double>(members.size()));
}

}  // namespace velum::shapes
