// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/icp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "registration/pair_sums.hpp"
#include "registration/sampling.hpp"
#include "registration/weighed_pairs.hpp"

namespace velum::registration {
namespace {

/// Errors below this share of the scene's square are zero to single precision.
constexpr double kExact = 1e-15;
/// Sampling leaves at least so many points.
constexpr Index kLeastSample = 100;

class Icp {
 public:
  Icp(const Cloud& source, const Cloud& target, const IcpOptions& options, Context& context)
      : source_(source), target_(target), options_(options), context_(context) {
    for (Index i = 0; i < source.size(); ++i)
      barycentre_ += source.positions().col(i).cast<double>();
    barycentre_ /= static_cast<double>(source.size());
    if (options.sampling == Sampling::random)
      source_ =
          source.select(random_sample(source, options.sample, kLeastSample, context.random()));
    else if (options.sampling == Sampling::curvature)
      source_ =
          source.select(curvature_sample(source, options.sample, kLeastSample, context.random()));
  }

  IcpResult run(const Pose& start) {
    result_.pose = start;
    for (int level = options_.levels - 1; level >= 0; --level) run_level(level);
    return std::move(result_);
  }

 private:
  void run_level(int level) {
    WeighedPairs pairs(every(Index{1} << (2 * level)), target_, options_);
    double before = std::numeric_limits<double>::quiet_NaN();
    result_.converged = false;
    for (int k = 0;; ++k) {
      context_.check();
      pairs.update(result_.pose, context_);
      const PairSums sums = sum_pairs(pairs, result_.pose * barycentre_, options_.metric, context_);
      require(sums, pairs);
      IcpStep step;
      step.pairs = sums.pairs();
      step.error = sums.error();
      step.relative_change = std::abs(before - step.error) / std::max(before, 1e-300);
      before = step.error;
      const double size = sums.radius();
      if (step.relative_change < options_.relative_change || step.error < kExact * size * size)
        result_.converged = true;
      const bool last = result_.converged || k == options_.iterations;
      if (!last) move(sums, step);
      step.barycentre = result_.pose * barycentre_ + target_.origin();
      result_.steps.push_back(step);
      if (last) {
        if (level == 0) finish(sums, pairs);
        return;
      }
      result_.converged = is_still(step);
      context_.progress(static_cast<double>(k + 1) / options_.iterations);
    }
  }

  [[nodiscard]] Cloud every(Index stride) const {
    if (stride == 1) return source_;
    std::vector<std::int32_t> chosen;
    for (Index i = 0; i < source_.size(); i += stride)
      chosen.push_back(static_cast<std::int32_t>(i));
    return source_.select(chosen);
  }

  void require(const PairSums& sums, const WeighedPairs& pairs) const {
    const Index least = pairs.planar() ? 6 : 3;
    if (sums.pairs() < least)
      throw Error(Fault::stage,
                  fmt::format("{} of {} source points have a target point{}{}; {} pairs are needed",
                              sums.pairs(), pairs.size(),
                              options_.normal_angle < std::numbers::pi ||
                                      options_.pairing == Pairing::reciprocal
                                  ? " that fits"
                                  : "",
                              std::isfinite(options_.max_distance)
                                  ? fmt::format(" within {:.6g} m", options_.max_distance)
                                  : "",
                              least))
          .hint(
              "bring the clouds closer first (registration.planes, registration.svd), or raise "
              "max_distance");
  }

  void move(const PairSums& sums, IcpStep& step) {
    const Pose motion = sums.motion(options_.solver);
    const Eigen::Vector3d start = result_.pose * barycentre_;
    result_.pose = motion * result_.pose;
    result_.pose.linear() = geometry::orthonormal(result_.pose.linear());
    step.rotation = geometry::angle_of(motion.linear());
    step.translation = (motion * start - start).norm();
    ++result_.iterations;
  }

  [[nodiscard]] bool is_still(const IcpStep& step) const {
    const bool asked = options_.still_rotation > 0.0 || options_.still_translation > 0.0;
    const auto below = [](double value, double limit) { return limit <= 0.0 || value < limit; };
    return asked && below(step.rotation, options_.still_rotation) &&
           below(step.translation, options_.still_translation);
  }

  void finish(const PairSums& sums, const WeighedPairs& pairs) {
    result_.pairs = sums.pairs();
    result_.fitness = sums.fitness();
    result_.overlap =
        static_cast<double>(pairs.closest().count()) / static_cast<double>(pairs.size());
    const NormalEquations equations = sums.equations();
    result_.uncertainty = estimate_uncertainty(pairs, pairs.planar() ? &equations : nullptr,
                                               result_.pose * barycentre_, sums.radius(), context_);
  }

  Cloud source_;
  const Cloud& target_;
  const IcpOptions& options_;
  Context& context_;
  Eigen::Vector3d barycentre_ = Eigen::Vector3d::Zero();
  IcpResult result_;
};

}  // namespace

IcpResult icp(const Cloud& source, const Cloud& target, const Pose& start,
              const IcpOptions& options, Context& context) {
  for (const auto& [cloud, name] : {std::pair(&source, "source"), std::pair(&target, "target")})
    if (cloud->empty()) throw Error(Fault::stage, fmt::format("the {} has no points", name));
  if (options.solver == Solver::svd && options.metric != Metric::point_to_point)
    throw Error(Fault::stage, "solver svd is for metric point_to_point, not for planes")
        .hint("solver = helical");
  return Icp(source, target, options, context).run(start);
}

Table history_table(const std::vector<IcpStep>& steps) {
  Table table({{"iteration", ""},
               {"pairs", ""},
               {"error", "m^2"},
               {"relative_change", ""},
               {"rotation", "rad"},
               {"translation", "m"},
               {"x", "m"},
               {"y", "m"},
               {"z", "m"}});
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const IcpStep& step = steps[k];
    table.add({static_cast<std::int64_t>(k), static_cast<std::int64_t>(step.pairs), step.error,
               step.relative_change, step.rotation, step.translation, step.barycentre.x(),
               step.barycentre.y(), step.barycentre.z()});
  }
  return table;
}

}  // namespace velum::registration
