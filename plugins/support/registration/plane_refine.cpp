// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/plane_refine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/eigen3.hpp"
#include "geometry/normals.hpp"
#include "registration/pairs.hpp"

namespace velum::registration {
namespace {

constexpr Index kGrain = 2048;
/// A plane counts for no more points than this: a wall is not flat to the last hundredth of a
/// millimetre, however often it was measured.
constexpr double kMostPlanePoints = 5000.0;
constexpr double kShrink = 0.6;
constexpr int kStepsEach = 4;
constexpr int kStepsLast = 12;
constexpr double kCutoff = 1e-7;
/// Cauchy weights fall to a half at this many deviations.
constexpr double kHalf = 3.0;
/// Fewer points than these on no plane are stray ones.
constexpr Index kLeastRest = 50;
/// Motions below this share of the scene end the refinement.
constexpr double kStill = 1e-7;

class Refinement {
 public:
  Refinement(const RoomScan& source, const RoomScan& target, const RestPair& rest,
             const Assignment& assignment, Context& context)
      : source_(source),
        target_(target),
        rest_(rest),
        assignment_(assignment),
        context_(context),
        pairs_(rest.source, rest.target) {
    refined_.pose = assignment.pose;
    for (Index i = 0; i < source.wall_thin.cols(); ++i)
      middle_ += source.wall_thin.col(i).cast<double>();
    middle_ /= static_cast<double>(std::max<Index>(1, source.wall_thin.cols()));
    double squares = 0.0;
    for (Index i = 0; i < source.wall_thin.cols(); ++i)
      squares += (source.wall_thin.col(i).cast<double>() - middle_).squaredNorm();
    refined_.radius =
        std::sqrt(squares / static_cast<double>(std::max<Index>(1, source.wall_thin.cols())));
  }

  Refined run(double first, double last) {
    double distance = std::max(first, last);
    while (true) {
      const bool final = distance <= last;
      for (int k = 0; k < (final ? kStepsLast : kStepsEach); ++k)
        if (step(distance) < kStill * refined_.radius) break;
      if (final) break;
      distance = std::max(last, distance * kShrink);
    }
    refined_.equations = equations(distance);
    refined_.sigma = std::sqrt(refined_.equations.mean_square());
    return std::move(refined_);
  }

 private:
  double step(double distance) {
    context_.check();
    const NormalEquations sums = equations(distance);
    const Pose motion = sums.solve(refined_.radius, kCutoff);
    const Eigen::Vector3d before = refined_.pose * middle_;
    refined_.pose = motion * refined_.pose;
    refined_.pose.linear() = geometry::orthonormal(refined_.pose.linear());
    IcpStep record;
    record.pairs = refined_.pairs;
    record.error = sums.mean_square();
    record.relative_change = refined_.steps.empty()
                                 ? std::numeric_limits<double>::quiet_NaN()
                                 : std::abs(record.error - refined_.steps.back().error) /
                                       std::max(refined_.steps.back().error, 1e-300);
    record.rotation = geometry::angle_of(motion.linear());
    record.translation = (motion * before - before).norm();
    record.barycentre = refined_.pose * middle_ + target_.cloud.origin();
    refined_.steps.push_back(record);
    return record.translation + record.rotation * refined_.radius;
  }

  NormalEquations equations(double distance) {
    NormalEquations sums(refined_.pose * middle_);
    add_planes(sums);
    add_rest(sums, distance);
    return sums;
  }

  /// A set of points enters by its mean and covariance alone, so six points with the same ones
  /// stand for all of a plane's.
  void add_planes(NormalEquations& sums) {
    double squares = 0.0;
    for (const PlaneMatch& m : assignment_.matches) {
      const auto& from = source_.scene.planes[static_cast<std::size_t>(m.source)];
      const auto& to = target_.scene.planes[static_cast<std::size_t>(m.target)];
      const auto a = static_cast<double>(from.points);
      const auto b = static_cast<double>(to.points);
      const double weight = std::min(kMostPlanePoints, a * b / (a + b)) / 6.0;
      const geometry::Eigen3 axes = geometry::eigen3(from.covariance);
      for (int k = 0; k < 6; ++k) {
        const double reach =
            (k % 2 == 0 ? 1.0 : -1.0) * std::sqrt(3.0 * std::max(0.0, axes.values[k / 2]));
        const Eigen::Vector3d point =
            refined_.pose * (from.fit.centroid + reach * axes.vectors.col(k / 2));
        sums.add(point, to.fit.normal, -to.fit.distance(point), weight);
      }
      squares += std::pow(to.fit.distance(refined_.pose * from.fit.centroid), 2);
    }
    refined_.plane_gap = std::sqrt(
        squares / static_cast<double>(std::max<std::size_t>(1, assignment_.matches.size())));
  }

  void add_rest(NormalEquations& sums, double distance) {
    refined_.pairs = 0;
    if (std::min(rest_.source.cols(), rest_.target.size()) < kLeastRest) return;
    pairs_.update(refined_.pose, distance, context_);
    const std::vector<double> gaps = rest_gaps();
    std::vector<double> sizes;
    for (const double gap : gaps)
      if (!std::isnan(gap)) sizes.push_back(std::abs(gap));
    refined_.pairs = static_cast<Index>(sizes.size());
    if (sizes.empty()) return;
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    // 1.4826 medians are one standard deviation of a normal distribution.
    const double half =
        std::min(kHalf * 1.4826 * *middle, 0.5 * distance) + 1e-12 * refined_.radius;
    const auto normals = rest_.target.normals();
    const auto part = [&](Index begin, Index end) {
      NormalEquations mine(sums.centre());
      for (Index i = begin; i < end; ++i) {
        const double gap = gaps[static_cast<std::size_t>(i)];
        if (std::isnan(gap)) continue;
        const double ratio = gap / half;
        mine.add(pairs_.moved(i), normals.col(pairs_.match(i)).cast<double>(), gap,
                 1.0 / ((1.0 + ratio * ratio) * (1.0 + ratio * ratio)));
      }
      return mine;
    };
    sums.add(parallel_reduce(
        context_, pairs_.size(), kGrain, NormalEquations(sums.centre()), part,
        [](NormalEquations& total, const NormalEquations& one) { total.add(one); }));
  }

  /// Distance of each point of the rest from its match's tangent plane; NaN where there is none.
  [[nodiscard]] std::vector<double> rest_gaps() const {
    const auto normals = rest_.target.normals();
    std::vector<double> gaps(static_cast<std::size_t>(pairs_.size()),
                             std::numeric_limits<double>::quiet_NaN());
    for (Index i = 0; i < pairs_.size(); ++i) {
      const std::int32_t match = pairs_.match(i);
      if (match >= 0)
        gaps[static_cast<std::size_t>(i)] =
            normals.col(match).cast<double>().dot(pairs_.target(match) - pairs_.moved(i));
    }
    return gaps;
  }

  const RoomScan& source_;
  const RoomScan& target_;
  const RestPair& rest_;
  const Assignment& assignment_;
  Context& context_;
  ClosestPairs pairs_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  Refined refined_;
};

}  // namespace

RestPair make_rest(const RoomScan& source, const RoomScan& target, Index most, Context& context) {
  RestPair rest;
  const auto n = static_cast<Index>(source.rest.size());
  const Index stride = std::max<Index>(1, (n + most - 1) / most);
  rest.source.resize(3, (n + stride - 1) / stride);
  for (Index i = 0; i < rest.source.cols(); ++i)
    rest.source.col(i) =
        source.cloud.positions().col(source.rest[static_cast<std::size_t>(i * stride)]);
  rest.target = target.cloud.select(target.rest);
  if (!rest.target.empty() && !rest.target.has(column::kNormals))
    rest.target = rest.target.with(
        column::kNormals, Column(geometry::estimate_normals(rest.target, {}, context).normals));
  return rest;
}

Refined refine(const RoomScan& source, const RoomScan& target, const RestPair& rest,
               const Assignment& assignment, double first, double last, Context& context) {
  return Refinement(source, target, rest, assignment, context).run(first, last);
}

}  // namespace velum::registration
