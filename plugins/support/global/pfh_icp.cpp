// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "global/pfh_icp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "features/histograms.hpp"
#include "features/matching.hpp"
#include "geometry/thinning.hpp"
#include "global/sampled.hpp"

namespace velum::registration {
namespace {

constexpr Index kWanted = 4000;
constexpr double kFeatureCells = 3.0;
constexpr Index kLeastPairs = 12;
/// The distance within which partners are drawn becomes shorter by this at each step, down to ...
constexpr double kShrink = 0.7;
/// ... so many cells: a partner is a neighbour of the right one.
constexpr double kLeastCells = 1.0;
constexpr double kNear = 1.5;  ///< cells; for the overlap
constexpr double kCutoff = 1e-5;
constexpr double kSlope = 0.5;  ///< cosine between the normals of a pair

class PfhIcp {
 public:
  PfhIcp(const Cloud& source, const Cloud& target, const PfhIcpOptions& options, Context& context)
      : options_(options), context_(context) {
    const auto cell_of = [](const Cloud& cloud) {
      return geometry::cell_for(cloud.positions(), std::min(kWanted, cloud.size() / 2));
    };
    SampleOptions sampling;
    sampling.cell = options.cell > 0.0 ? options.cell : std::max(cell_of(source), cell_of(target));
    sampling.feature_cells = kFeatureCells;
    sampling.full = true;
    const auto share = [&](const Cloud& cloud) {
      const auto n = geometry::thin(cloud.positions(), sampling.cell).means.cols();
      return std::max<Index>(1, static_cast<Index>(options.uncommon * static_cast<double>(n)));
    };
    sampling.keys = share(source);
    source_ = sample(source, sampling, context);
    sampling.keys = share(target);
    target_ = sample(target, sampling, context);
    cell_ = std::max(source_.cell, target_.cell);
    limit_ = options.max_distance > 0.0 ? options.max_distance : source.diagonal() / 3.0;
    least_ = std::min(limit_, kLeastCells * cell_);
    middle_ = source_.cloud.positions().cast<double>().rowwise().mean();
  }

  PfhIcpResult run(const Pose& start) {
    result_.pose = start;
    find_similar();
    double before = std::numeric_limits<double>::quiet_NaN();
    for (int k = 0;; ++k) {
      context_.check();
      const NormalEquations sums = draw();
      IcpStep step;
      step.pairs = result_.pairs;
      step.error = sums.mean_square();
      step.relative_change = std::abs(before - step.error) / std::max(before, 1e-300);
      result_.converged = limit_ <= least_ && step.relative_change < options_.relative_change;
      const bool last = result_.converged || k == options_.iterations;
      if (last)
        result_.directions = sums.directions(std::max(radius_, cell_));
      else
        move(sums, step);
      step.barycentre = result_.pose * middle_ + target_.cloud.origin();
      result_.steps.push_back(step);
      before = step.error;
      if (last) break;
      shrink();
      context_.progress(static_cast<double>(k + 1) / options_.iterations);
    }
    judge();
    return std::move(result_);
  }

 private:
  void find_similar() {
    Eigen::MatrixXf both(target_.features.rows(), 2 * target_.features.cols());
    both << target_.features, features::mirrored_pfh(target_.features);
    similar_ = features::nearest_features(source_.features, both, options_.similar, context_).index;
  }

  /// Pairs of this iteration: for every key one of the like ones within the limit, at random.
  NormalEquations draw() {
    const Random stream = context_.random().split(draws_);
    const auto count = static_cast<int>(target_.keys.size());
    NormalEquations sums(result_.pose * middle_);
    radius_ = 0.0;
    result_.pairs = 0;
    std::vector<std::int32_t> near;
    for (std::size_t i = 0; i < source_.keys.size(); ++i) {
      const Eigen::Vector3d moved =
          result_.pose * source_.cloud.positions().col(source_.keys[i]).cast<double>();
      const Eigen::Vector3d normal =
          result_.pose.linear() * source_.cloud.normals().col(source_.keys[i]).cast<double>();
      near.clear();
      for (Index k = 0; k < similar_.rows(); ++k) {
        const int found = similar_(k, static_cast<Index>(i));
        if (found < 0) continue;
        const auto q = target_.keys[static_cast<std::size_t>(found % count)];
        if ((position(q) - moved).norm() <= limit_ &&
            std::abs(target_.cloud.normals().col(q).cast<double>().dot(normal)) > kSlope)
          near.push_back(q);
      }
      if (near.empty()) continue;
      Random random = stream.split(i);
      const auto q =
          near[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(near.size())))];
      const Eigen::Vector3d to = target_.cloud.normals().col(q).cast<double>();
      sums.add(moved, to, to.dot(position(q) - moved));
      radius_ += (moved - sums.centre()).squaredNorm();
      ++result_.pairs;
    }
    require_pairs();
    radius_ = std::sqrt(radius_ / static_cast<double>(result_.pairs));
    return sums;
  }

  /// Once as short as can be, the same draw is made each time, so that the error can settle.
  void shrink() {
    if (limit_ <= least_) return;
    limit_ = std::max(least_, kShrink * limit_);
    ++draws_;
  }

  [[nodiscard]] Eigen::Vector3d position(std::int32_t target) const {
    return target_.cloud.positions().col(target).cast<double>();
  }

  void require_pairs() const {
    if (result_.pairs >= kLeastPairs) return;
    throw Error(Fault::stage,
                fmt::format("{} of {} uncommon source points have a target point that looks like "
                            "them within {:.6g} m; {} pairs are needed",
                            result_.pairs, source_.keys.size(), limit_, kLeastPairs))
        .hint("bring the clouds closer first (registration.global), or raise max_distance");
  }

  void move(const NormalEquations& sums, IcpStep& step) {
    const Pose motion = sums.solve(std::max(radius_, cell_), kCutoff);
    const Eigen::Vector3d before = result_.pose * middle_;
    result_.pose = motion * result_.pose;
    result_.pose.linear() = geometry::orthonormal(result_.pose.linear());
    step.rotation = geometry::angle_of(motion.linear());
    step.translation = (motion * before - before).norm();
  }

  void judge() {
    double squares = 0.0;
    Index near = 0;
    for (Index i = 0; i < source_.cloud.size(); ++i) {
      const Eigen::Vector3d moved = result_.pose * source_.cloud.positions().col(i).cast<double>();
      const Neighbour found =
          target_.cloud.neighbours().nearest_one(moved.cast<float>(), kNear * cell_);
      if (found.index < 0) continue;
      ++near;
      squares += static_cast<double>(found.distance2);
    }
    if (near == 0)
      throw Error(
          Fault::stage,
          fmt::format("after {} iterations no source point lies within {:.6g} m of the target",
                      result_.steps.size() - 1, kNear * cell_))
          .hint("bring the clouds closer first (registration.global)");
    result_.overlap = static_cast<double>(near) / static_cast<double>(source_.cloud.size());
    result_.fitness = squares / static_cast<double>(near);
  }

  const PfhIcpOptions& options_;
  Context& context_;
  Sampled source_;
  Sampled target_;
  Eigen::MatrixXi similar_;  ///< numbers of target keys; from keys.size() on seen from behind
  double cell_ = 0.0;
  double limit_ = 0.0;  ///< of a pair [m]
  double least_ = 0.0;  ///< of limit_ [m]
  std::uint64_t draws_ = 0;
  double radius_ = 0.0;
  Eigen::Vector3d middle_;
  PfhIcpResult result_;
};

}  // namespace

PfhIcpResult pfh_icp(const Cloud& source, const Cloud& target, const Pose& start,
                     const PfhIcpOptions& options, Context& context) {
  for (const auto& [cloud, name] : {std::pair(&source, "source"), std::pair(&target, "target")})
    if (cloud->size() < kLeastPairs || !(cloud->diagonal() > 0.0))
      throw Error(Fault::stage,
                  fmt::format("the {} has {} points or all in one place; {} are needed", name,
                              cloud->size(), kLeastPairs));
  return PfhIcp(source, target, options, context).run(start);
}

}  // namespace velum::registration
