// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/plane_matching.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "geometry/eigen3.hpp"
#include "geometry/motion.hpp"
#include "geometry/rigid_fit.hpp"

namespace velum::registration {
namespace {

using geometry::ScenePlane;
using Planes = std::vector<ScenePlane>;

/// Planes that start rotations; smaller ones only join.
constexpr std::size_t kSeeds = 8;
/// Cosine of the least angle between two planes that fix a rotation (20°).
constexpr double kSpan = 0.94;
/// Rotations nearer than this are one [rad].
constexpr double kSameTurn = 0.07;
/// Assignments with less than this share of the best one's support are not looked at.
constexpr double kLeastSupport = 0.35;
/// Offsets tried along one direction, best supported first.
constexpr std::size_t kShifts = 4;
/// Eigenvalue share below which a direction of shift is free: planes within 10° of parallel to it.
constexpr double kFree = 0.03;

const Eigen::Vector3d& normal(const Planes& planes, int i) {
  return planes[static_cast<std::size_t>(i)].fit.normal;
}

double common_area(const Planes& source, const Planes& target, const PlaneMatch& m) {
  return std::min(source[static_cast<std::size_t>(m.source)].area,
                  target[static_cast<std::size_t>(m.target)].area);
}

/// Pairs of planes whose normals agree under a rotation.
std::vector<PlaneMatch> parallel(const Planes& source, const Planes& target,
                                 const Eigen::Matrix3d& turn, double angle) {
  std::vector<PlaneMatch> found;
  for (int i = 0; i < static_cast<int>(source.size()); ++i)
    for (int j = 0; j < static_cast<int>(target.size()); ++j)
      if ((turn * normal(source, i)).dot(normal(target, j)) > std::cos(angle))
        found.push_back({i, j});
  return found;
}

Eigen::Matrix3d turn_of(const Planes& source, const Planes& target,
                        const std::vector<PlaneMatch>& matches) {
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  for (const PlaneMatch& m : matches)
    correlation += common_area(source, target, m) * normal(source, m.source) *
                   normal(target, m.target).transpose();
  return geometry::best_rotation(correlation);
}

/// Rotations that carry two planes of the source onto two of the target, each once.
std::vector<Eigen::Matrix3d> rotations(const Planes& source, const Planes& target, double angle) {
  std::vector<Eigen::Matrix3d> turns;
  const int ns = static_cast<int>(std::min(source.size(), kSeeds));
  const int nt = static_cast<int>(std::min(target.size(), kSeeds));
  const auto try_pair = [&](int a, int b, int c, int d) {
    const double between = normal(source, a).dot(normal(source, b));
    const double there = normal(target, c).dot(normal(target, d));
    if (std::abs(between) > kSpan || std::abs(std::acos(between) - std::acos(there)) > angle)
      return;
    const Eigen::Matrix3d turn = turn_of(source, target, {{a, c}, {b, d}});
    for (const Eigen::Matrix3d& known : turns)
      if (geometry::angle_of(known.transpose() * turn) < kSameTurn) return;
    turns.push_back(turn);
  };
  for (int a = 0; a < ns; ++a)
    for (int b = a + 1; b < ns; ++b)
      for (int c = 0; c < nt; ++c)
        for (int d = 0; d < nt; ++d)
          if (c != d && std::abs(normal(target, c).dot(normal(target, d))) < kSpan)
            try_pair(a, b, c, d);
  return turns;
}

/// A shift along one direction, and the pairs of planes that ask for it.
struct Shift {
  double value;
  double support;
  std::vector<PlaneMatch> matches;
};
/// Pairs of planes that are parallel to each other within the scene: one direction of shift.
struct Direction {
  Eigen::Vector3d axis;
  std::vector<PlaneMatch> matches;
  std::vector<Shift> shifts;
};

class Shifts {
 public:
  Shifts(const Planes& source, const Planes& target, const Eigen::Matrix3d& turn,
         const MatchOptions& options)
      : source_(source), target_(target), turn_(turn), options_(options) {
    for (const PlaneMatch& m : parallel(source, target, turn, options.angle)) place(m);
    for (Direction& direction : directions_) find_shifts(direction);
    // The directions that carry most area are enumerated; the others join where they agree.
    std::stable_sort(directions_.begin(), directions_.end(), [](const auto& a, const auto& b) {
      return a.shifts.front().support > b.shifts.front().support;
    });
    std::vector<Direction> independent;
    for (const Direction& direction : directions_)
      if (independent.size() < 3 && is_independent(independent, direction.axis))
        independent.push_back(direction);
    directions_ = std::move(independent);
  }

  /// Every choice of one shift, or none, for each direction.
  void enumerate(std::vector<Assignment>& out) {
    chosen_.clear();
    choose(0, out);
  }

 private:
  void place(const PlaneMatch& m) {
    for (Direction& direction : directions_)
      if (std::abs(direction.axis.dot(normal(target_, m.target))) > kSpan) {
        direction.matches.push_back(m);
        return;
      }
    directions_.push_back({normal(target_, m.target), {m}, {}});
  }

  [[nodiscard]] double gap(const PlaneMatch& m) const {
    const auto& target = target_[static_cast<std::size_t>(m.target)].fit;
    return -target.distance(turn_ * source_[static_cast<std::size_t>(m.source)].fit.centroid);
  }

  void find_shifts(Direction& direction) const {
    for (const PlaneMatch& seed : direction.matches) {
      const double sign = direction.axis.dot(normal(target_, seed.target)) < 0.0 ? -1.0 : 1.0;
      Shift shift{sign * gap(seed), 0.0, {}};
      for (const PlaneMatch& m : direction.matches) {
        const double side = direction.axis.dot(normal(target_, m.target)) < 0.0 ? -1.0 : 1.0;
        if (std::abs(side * gap(m) - shift.value) > options_.offset) continue;
        shift.matches.push_back(m);
        shift.support += common_area(source_, target_, m);
      }
      const bool known =
          std::any_of(direction.shifts.begin(), direction.shifts.end(), [&](const Shift& other) {
            return std::abs(other.value - shift.value) < options_.offset;
          });
      if (!known) direction.shifts.push_back(std::move(shift));
    }
    std::stable_sort(direction.shifts.begin(), direction.shifts.end(),
                     [](const Shift& a, const Shift& b) { return a.support > b.support; });
    if (direction.shifts.size() > kShifts) direction.shifts.resize(kShifts);
  }

  static bool is_independent(const std::vector<Direction>& others, const Eigen::Vector3d& axis) {
    if (others.size() < 2) return others.empty() || std::abs(others.front().axis.dot(axis)) < kSpan;
    const Eigen::Vector3d across = others[0].axis.cross(others[1].axis).normalized();
    return std::abs(across.dot(axis)) > 0.34;
  }

  void choose(std::size_t depth, std::vector<Assignment>& out) {
    if (depth == directions_.size()) {
      if (chosen_.size() + 1 >= directions_.size() && chosen_.size() >= 2) finish(out);
      return;
    }
    for (const Shift& shift : directions_[depth].shifts) {
      chosen_.push_back(&shift);
      choose(depth + 1, out);
      chosen_.pop_back();
    }
    choose(depth + 1, out);
  }

  void finish(std::vector<Assignment>& out) const {
    Assignment assignment;
    for (const Shift* shift : chosen_) {
      assignment.matches.insert(assignment.matches.end(), shift->matches.begin(),
                                shift->matches.end());
      assignment.support += shift->support;
    }
    for (const PlaneMatch& pick : options_.picks)
      if (std::none_of(assignment.matches.begin(), assignment.matches.end(), [&](const auto& m) {
            return m.source == pick.source && m.target == pick.target;
          }))
        return;
    solve(assignment);
    out.push_back(std::move(assignment));
  }

  /// Rotation from all normals, then the shift from all offsets, each weighted by area.
  void solve(Assignment& assignment) const {
    assignment.pose.linear() = turn_of(source_, target_, assignment.matches);
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const PlaneMatch& m : assignment.matches) {
      const double weight = common_area(source_, target_, m);
      const auto& target = target_[static_cast<std::size_t>(m.target)].fit;
      const Eigen::Vector3d centre =
          assignment.pose.linear() * source_[static_cast<std::size_t>(m.source)].fit.centroid;
      matrix += weight * target.normal * target.normal.transpose();
      right -= weight * target.distance(centre) * target.normal;
    }
    const geometry::Eigen3 eigen = geometry::eigen3(matrix);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d axis = eigen.vectors.col(k);
      if (eigen.values[k] < kFree * eigen.values[2])
        assignment.free.push_back(axis);
      else
        assignment.pose.translation() += axis * (axis.dot(right) / eigen.values[k]);
    }
  }

  const Planes& source_;
  const Planes& target_;
  Eigen::Matrix3d turn_;
  const MatchOptions& options_;
  std::vector<Direction> directions_;
  std::vector<const Shift*> chosen_;
};

}  // namespace

std::vector<Assignment> match_planes(const Planes& source, const Planes& target,
                                     const MatchOptions& options) {
  std::vector<Assignment> all;
  for (Eigen::Matrix3d turn : rotations(source, target, options.angle)) {
    turn = turn_of(source, target, parallel(source, target, turn, 2.0 * options.angle));
    Shifts(source, target, turn, options).enumerate(all);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.support > b.support; });
  const auto enough = std::find_if(all.begin(), all.end(), [&](const Assignment& one) {
    return one.support < kLeastSupport * all.front().support;
  });
  all.erase(enough, all.end());
  return all;
}

}  // namespace velum::registration
