// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/weighed_pairs.hpp"

#include <algorithm>
#include <cmath>

namespace velum::registration {
namespace {

constexpr Index kGrain = 4096;
/// A median absolute value of a normal distribution, times this, is its standard deviation.
constexpr double kDeviations = 1.4826;
/// Kernels' limits in standard deviations: 95 % efficiency under normal noise.
constexpr double kHuber = 1.345;
constexpr double kTukey = 4.685;
/// A point back at the source is nearer only by more than rounding.
constexpr double kNearer = 1.0 - 1e-5;
/// Scales below this share of the target's size are rounding.
constexpr double kRounding = 1e-9;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// Normals of points without neighbours may be unset or not finite: such pairs say nothing.
bool is_unit(const Eigen::Vector3d& normal) {
  return std::abs(normal.squaredNorm() - 1.0) < 0.1;
}

/// The value that a share of the others does not exceed; 0 of none.
double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

}  // namespace

WeighedPairs::WeighedPairs(const Cloud& source, const Cloud& target, const IcpOptions& options)
    : target_(target), options_(options), pairs_(source.positions(), target) {
  const bool angle = options.normal_angle < std::numbers::pi;
  const bool both = angle || options.metric == Metric::symmetric;
  if (angle) least_cosine_ = std::cos(options.normal_angle);
  if (both || options.metric == Metric::point_to_plane) {
    target_normals_.emplace(target_.normals());
    normals_ = Points::Zero(3, size());
    normal_of_.assign(static_cast<std::size_t>(size()), -1);
  }
  if (both) {
    const auto given = source.normals();
    source_normals_.resize(3, size());
    for (Index i = 0; i < size(); ++i) source_normals_.col(i) = given.col(pairs_.original(i));
  }
  if (options.pairing == Pairing::reciprocal) mutual_source_.emplace(pairs_.source());
}

void WeighedPairs::update(const Pose& pose, Context& context) {
  pairs_.update(pose, options_.max_distance, context);
  if (target_normals_) fetch_normals(context);
  if (options_.keep < 1.0 || options_.kernel != Kernel::none || mutual_source_)
    find_limits(context);
}

void WeighedPairs::fetch_normals(Context& context) {
  parallel_for(context, size(), kGrain, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const std::int32_t match = pairs_.match(i);
      auto& of = normal_of_[static_cast<std::size_t>(i)];
      if (match < 0 || match == of) continue;
      of = match;
      normals_.col(i) = target_normals_->col(match);
    }
  });
}

bool WeighedPairs::build(Index i, Pair& pair) const {
  if (pairs_.match(i) < 0) return false;
  pair.point = pairs_.moved(i);
  pair.target = pairs_.matched(i);
  pair.at = pair.point;
  pair.weight = 1.0;
  if (!target_normals_) {
    pair.gap = (pair.target - pair.point).norm();
    return true;
  }
  pair.normal = normals_.col(i).cast<double>();
  if (!is_unit(pair.normal)) return false;
  if (source_normals_.cols() > 0) {
    const Eigen::Vector3d own = pairs_.pose().linear() * source_normals_.col(i).cast<double>();
    if (!is_unit(own)) return false;
    const double cosine = own.dot(pair.normal);
    if (cosine < least_cosine_) return false;
    if (options_.metric == Metric::symmetric) {
      // Two scanners may have seen one sheet from either side.
      pair.normal = 0.5 * (pair.normal + std::copysign(1.0, cosine) * own);
      pair.at = 0.5 * (pair.point + pair.target);
    }
  }
  pair.gap = options_.metric == Metric::point_to_point ? (pair.target - pair.point).norm()
                                                       : pair.normal.dot(pair.target - pair.point);
  return true;
}

bool WeighedPairs::mutual(Index i, const Pair& pair) const {
  const Eigen::Vector3f back = (pairs_.pose().inverse() * pair.target).cast<float>();
  const double nearer = kNearer * (pair.target - pair.point).norm();
  const Neighbour other = mutual_source_->neighbours().nearest_one(back, nearer);
  return other.index < 0 || other.index == static_cast<std::int32_t>(i);
}

void WeighedPairs::find_limits(Context& context) {
  gaps_.assign(static_cast<std::size_t>(size()), kNone);
  parallel_for(context, size(), kGrain, [&](Index begin, Index end) {
    Pair pair;
    for (Index i = begin; i < end; ++i)
      if (build(i, pair) && (!mutual_source_ || mutual(i, pair)))
        gaps_[static_cast<std::size_t>(i)] = static_cast<float>(std::abs(pair.gap));
  });
  std::vector<double> values;
  values.reserve(gaps_.size());
  if (options_.keep < 1.0) {
    for (Index i = 0; i < size(); ++i)
      if (!std::isnan(gaps_[static_cast<std::size_t>(i)])) values.push_back(pairs_.distance(i));
    limit_ = quantile(values, options_.keep);
  }
  if (options_.kernel == Kernel::none) return;
  values.clear();
  for (Index i = 0; i < size(); ++i) {
    const float gap = gaps_[static_cast<std::size_t>(i)];
    if (!std::isnan(gap) && pairs_.distance(i) <= limit_)
      values.push_back(static_cast<double>(gap));
  }
  scale_ = options_.kernel_scale > 0.0 ? options_.kernel_scale
                                       : std::max(kDeviations * quantile(values, 0.5),
                                                  kRounding * target_.diagonal() + 1e-300);
}

double WeighedPairs::weight_of(double gap) const {
  const double size = std::abs(gap) / scale_;
  switch (options_.kernel) {
    case Kernel::none:
      return 1.0;
    case Kernel::huber:
      return size <= kHuber ? 1.0 : kHuber / size;
    case Kernel::tukey: {
      const double ratio = std::min(1.0, size / kTukey);
      return (1.0 - ratio * ratio) * (1.0 - ratio * ratio);
    }
  }
  return 1.0;
}

bool WeighedPairs::get(Index i, Pair& pair) const {
  if (!gaps_.empty() &&
      (std::isnan(gaps_[static_cast<std::size_t>(i)]) || pairs_.distance(i) > limit_))
    return false;
  if (!build(i, pair)) return false;
  pair.weight = weight_of(pair.gap);
  return pair.weight > 0.0;
}

}  // namespace velum::registration
