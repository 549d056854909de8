// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "velum/cloud.hpp"
#include "velum/column.hpp"
#include "velum/random.hpp"

namespace velum::test {

/// A room for tests of registration, ray-cast without any other part of the project: an
/// axis-aligned box seen from within, open at both ends of x where `ends` is false, with spheres
/// cut to a box of their own (sails) and whole ellipsoids (hull) inside.
struct Room {
  Eigen::Vector3d low{-8.0, -3.0, 0.0};
  Eigen::Vector3d high{8.0, 4.0, 4.0};
  bool ends = true;
  struct Ball {
    Eigen::Vector3d centre;
    Eigen::Vector3d radii;
    Eigen::AlignedBox3d part;
  };
  std::vector<Ball> balls;

  /// Hull, mainsail and gennaker, about as in a tunnel.
  static Room tunnel(bool ends) {
    Room room;
    room.ends = ends;
    const auto all =
        Eigen::AlignedBox3d(Eigen::Vector3d::Constant(-99), Eigen::Vector3d::Constant(99));
    room.balls.push_back({{0.0, 0.0, 0.35}, {1.1, 0.3, 0.25}, all});
    room.balls.push_back(
        {{0.5, -2.2, 1.6},
         {2.4, 2.4, 3.0},
         Eigen::AlignedBox3d(Eigen::Vector3d(-0.1, -0.2, 0.7), Eigen::Vector3d(1.0, 0.6, 2.8))});
    room.balls.push_back(
        {{-0.9, 0.6, 1.5},
         {0.9, 1.3, 1.6},
         Eigen::AlignedBox3d(Eigen::Vector3d(-2.2, -1.0, 0.6), Eigen::Vector3d(-0.4, 0.1, 2.7))});
    return room;
  }

  [[nodiscard]] std::optional<double> meet(const Eigen::Vector3d& eye,
                                           const Eigen::Vector3d& way) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (int axis = ends ? 0 : 1; axis < 3; ++axis) {
      const double wall = way[axis] > 0.0 ? high[axis] : low[axis];
      if (way[axis] != 0.0) nearest = std::min(nearest, (wall - eye[axis]) / way[axis]);
    }
    for (const Ball& ball : balls) {
      const Eigen::Vector3d p = (eye - ball.centre).cwiseQuotient(ball.radii);
      const Eigen::Vector3d d = way.cwiseQuotient(ball.radii);
      const double a = d.squaredNorm();
      const double b = p.dot(d);
      const double root = b * b - a * (p.squaredNorm() - 1.0);
      if (root < 0.0) continue;
      for (const double sign : {-1.0, 1.0}) {
        const double t = (-b + sign * std::sqrt(root)) / a;
        if (t > 0.05 && ball.part.contains(eye + t * way)) nearest = std::min(nearest, t);
      }
    }
    if (!(nearest < 30.0)) return std::nullopt;
    return nearest;
  }

  /// What a scanner at `pose` (scanner → room) sees, in its own frame: fans of ±95° about x, tilted
  /// by ±`tilt` [rad] about y, one beam every `step` [rad], range noise `noise` [m].
  [[nodiscard]] Cloud scan(const Pose& pose, double step, double noise, std::uint64_t seed,
                           double tilt = 1.2) const {
    Random random(seed);
    std::vector<Eigen::Vector3f> found;
    for (double t = -tilt; t <= tilt; t += step)
      for (double a = -1.658; a <= 1.658; a += step) {
        const Eigen::Vector3d way = Eigen::AngleAxisd(t, Eigen::Vector3d::UnitY()) *
                                    Eigen::Vector3d(std::cos(a), std::sin(a), 0.0);
        const auto range = meet(pose.translation(), pose.linear() * way);
        if (range) found.push_back(((*range + noise * random.gaussian()) * way).cast<float>());
      }
    Points points(3, static_cast<Index>(found.size()));
    for (std::size_t i = 0; i < found.size(); ++i) points.col(static_cast<Index>(i)) = found[i];
    return Cloud(std::move(points)).with_sensors({{"scanner", Pose::Identity()}});
  }
};

/// A scanner at `eye` that looks towards `at`, z up.
inline Pose looking(const Eigen::Vector3d& eye, const Eigen::Vector3d& at) {
  Pose pose = Pose::Identity();
  const Eigen::Vector3d x = (at - eye).normalized();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitZ().cross(x).normalized();
  pose.linear() << x, y, x.cross(y);
  pose.translation() = eye;
  return pose;
}

/// Any rotation with equal chance, and a shift of up to `reach` [m] on each axis.
inline Pose random_pose(Random& random, double reach) {
  Eigen::Quaterniond q(random.gaussian(), random.gaussian(), random.gaussian(), random.gaussian());
  Pose pose = Pose::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  for (int k = 0; k < 3; ++k) pose.translation()[k] = random.uniform(-reach, reach);
  return pose;
}

}  // namespace velum::test
