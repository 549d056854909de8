// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "global/judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace velum::registration {
namespace {

/// A point lies on the other cloud with a neighbour this near, in cells, ...
constexpr double kReach = 1.5;
/// ... no more than this off its tangent plane, ...
constexpr double kOff = 0.5;
/// ... and with a normal no more than about 37° away, whatever its sign.
constexpr double kCosine = 0.8;
constexpr double kShrink = 0.6;
constexpr int kStepsEach = 4;
constexpr int kStepsLast = 12;
constexpr double kCutoff = 1e-6;
constexpr double kStill = 1e-6;
constexpr Index kGrain = 256;

Index stride_for(Index points, Index most) {
  return std::max<Index>(1, (points + most - 1) / std::max<Index>(1, most));
}

}  // namespace

Judge::Judge(const Sampled& source, const Sampled& target, Context& context)
    : source_(source),
      target_(target),
      context_(context),
      cell_(std::max(source.cell, target.cell)) {
  for (Index i = 0; i < source.cloud.size(); ++i)
    middle_ += source.cloud.positions().col(i).cast<double>();
  middle_ /= static_cast<double>(std::max<Index>(1, source.cloud.size()));
}

Judge::Near Judge::near(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                        double reach) const {
  const Neighbour found = target_.cloud.neighbours().nearest_one(point.cast<float>(), reach);
  if (found.index < 0) return {};
  const Eigen::Vector3d there = target_.cloud.normals().col(found.index).cast<double>();
  if (std::abs(there.dot(normal)) < kCosine) return {};
  const Eigen::Vector3d to = target_.cloud.positions().col(found.index).cast<double>() - point;
  return {found.index, std::sqrt(static_cast<double>(found.distance2)), there.dot(to)};
}

double Judge::weight(const Near& found) const {
  if (found.index < 0) return 0.0;
  const double off = found.gap / (kOff * cell_);
  return std::max(0.0, 1.0 - off * off);
}

double Judge::rarity(Index source, const Near& found) const {
  if (found.index < 0) return 0.0;
  return static_cast<double>(std::min(source_.rarity[static_cast<std::size_t>(source)],
                                      target_.rarity[static_cast<std::size_t>(found.index)]));
}

std::vector<float> Judge::borne_out(const Pose& pose) const {
  const auto positions = source_.cloud.positions();
  const auto normals = source_.cloud.normals();
  std::vector<float> weights(static_cast<std::size_t>(positions.cols()));
  parallel_for(context_, positions.cols(), kGrain, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const Near found = near(pose * positions.col(i).cast<double>(),
                              pose.linear() * normals.col(i).cast<double>(), kReach * cell_);
      weights[static_cast<std::size_t>(i)] = static_cast<float>(weight(found) * rarity(i, found));
    }
  });
  return weights;
}

Agreement Judge::agreement(const Pose& pose, Index most) const {
  struct Sum {
    double weight = 0.0;
    double evidence = 0.0;
    double squares = 0.0;
    Index pairs = 0;
  };
  const Index stride = stride_for(source_.cloud.size(), most);
  const Index count = (source_.cloud.size() + stride - 1) / stride;
  const auto positions = source_.cloud.positions();
  const auto normals = source_.cloud.normals();
  const auto part = [&](Index begin, Index end) {
    Sum sum;
    for (Index i = begin; i < end; ++i) {
      const Near found =
          near(pose * positions.col(i * stride).cast<double>(),
               pose.linear() * normals.col(i * stride).cast<double>(), kReach * cell_);
      if (found.index < 0) continue;
      sum.weight += weight(found);
      sum.evidence += weight(found) * rarity(i * stride, found);
      sum.squares += found.distance * found.distance;
      ++sum.pairs;
    }
    return sum;
  };
  const Sum sum =
      parallel_reduce(context_, count, kGrain, Sum{}, part, [](Sum& total, const Sum& one) {
        total.weight += one.weight;
        total.evidence += one.evidence;
        total.squares += one.squares;
        total.pairs += one.pairs;
      });
  Agreement result;
  const auto asked = static_cast<double>(std::max<Index>(1, count));
  // Cells of one size: points count area, so the smaller cloud has the fewer.
  const double smaller = std::min(
      1.0, static_cast<double>(target_.cloud.size()) / static_cast<double>(source_.cloud.size()));
  result.share = std::min(1.0, sum.weight / (asked * smaller));
  result.evidence = sum.evidence / asked;
  result.overlap = static_cast<double>(sum.pairs) / asked;
  result.fitness = sum.pairs > 0 ? sum.squares / static_cast<double>(sum.pairs) : -1.0;
  return result;
}

NormalEquations Judge::equations(const Pose& pose, double reach, Index stride, double& radius,
                                 Index& pairs) const {
  const auto positions = source_.cloud.positions();
  const auto normals = source_.cloud.normals();
  const Eigen::Vector3d centre = pose * middle_;
  struct Sum {
    NormalEquations equations;
    double squares = 0.0;
    Index pairs = 0;
  };
  const double half = 0.3 * reach;
  const auto part = [&](Index begin, Index end) {
    Sum sum{NormalEquations(centre)};
    for (Index i = begin; i < end; ++i) {
      const Eigen::Vector3d moved = pose * positions.col(i * stride).cast<double>();
      const Near found = near(moved, pose.linear() * normals.col(i * stride).cast<double>(), reach);
      if (found.index < 0) continue;
      const double ratio = found.gap / half;
      sum.equations.add(moved, target_.cloud.normals().col(found.index).cast<double>(), found.gap,
                        1.0 / ((1.0 + ratio * ratio) * (1.0 + ratio * ratio)));
      sum.squares += (moved - centre).squaredNorm();
      ++sum.pairs;
    }
    return sum;
  };
  const Index count = (source_.cloud.size() + stride - 1) / stride;
  const Sum sum = parallel_reduce(context_, count, kGrain, Sum{NormalEquations(centre)}, part,
                                  [](Sum& total, const Sum& one) {
                                    total.equations.add(one.equations);
                                    total.squares += one.squares;
                                    total.pairs += one.pairs;
                                  });
  pairs = sum.pairs;
  radius =
      std::max(std::sqrt(sum.squares / static_cast<double>(std::max<Index>(1, sum.pairs))), cell_);
  return sum.equations;
}

JudgeRefined Judge::refine(const Pose& pose, double first, double last, Index most) const {
  JudgeRefined refined;
  refined.pose = pose;
  const Index stride = stride_for(source_.cloud.size(), most);
  Index pairs = 0;
  for (double reach = std::max(first, last);; reach = std::max(last, reach * kShrink)) {
    const bool final = reach <= last;
    for (int k = 0; k < (final ? kStepsLast : kStepsEach); ++k) {
      context_.check();
      const NormalEquations sums = equations(refined.pose, reach, stride, refined.radius, pairs);
      if (pairs < 6) return refined;
      const Pose motion = sums.solve(refined.radius, kCutoff);
      const Eigen::Vector3d before = refined.pose * middle_;
      refined.pose = motion * refined.pose;
      refined.pose.linear() = geometry::orthonormal(refined.pose.linear());
      IcpStep step;
      step.pairs = pairs;
      step.error = sums.mean_square();
      step.relative_change = refined.steps.empty()
                                 ? std::numeric_limits<double>::quiet_NaN()
                                 : std::abs(step.error - refined.steps.back().error) /
                                       std::max(refined.steps.back().error, 1e-300);
      step.rotation = geometry::angle_of(motion.linear());
      step.translation = (motion * before - before).norm();
      step.barycentre = refined.pose * middle_ + target_.cloud.origin();
      refined.steps.push_back(step);
      if (step.translation + step.rotation * refined.radius < kStill * refined.radius) break;
    }
    if (final) break;
  }
  refined.equations = equations(refined.pose, last, stride, refined.radius, pairs);
  return refined;
}

}  // namespace velum::registration
