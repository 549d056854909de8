// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "geometry/eigen3.hpp"
#include "global/hypotheses.hpp"
#include "global/register_globally.hpp"

namespace velum::registration {
namespace {

constexpr Index kNearest = 3;
constexpr Index kMatches = 2500;
constexpr std::size_t kHypotheses = 60;
constexpr std::size_t kFinalists = 10;
constexpr Index kFewPoints = 500;
constexpr Index kSomePoints = 1200;
constexpr double kBound = 1.5;  ///< how far a right match may be off, in cells
/// A direction fixed less than this, of one that every point fixes, is free.
constexpr double kFree = 5e-3;
/// This share of the gap asked for will do where hardly anything speaks for the next pose alone.
constexpr double kClearGap = 0.3;
constexpr double kDominant = 0.7;

class Attempt {
 public:
  Attempt(const Cloud& source, const Cloud& target, double cell, const GlobalOptions& options,
          Context& context)
      : options_(options), context_(context) {
    SampleOptions sampling;
    sampling.cell = cell;
    source_ = sample(source, sampling, context);
    target_ = sample(target, sampling, context);
    cell_ = std::max(source_.cell, target_.cell);
    place_ = source_.cloud.positions().cast<double>().rowwise().mean();
    result_.cell = cell_;
  }

  GlobalResult run() {
    const std::vector<Match> matches =
        match_features(source_, target_, kNearest, kMatches, context_);
    result_.matches = static_cast<Index>(matches.size());
    const Judge judge(source_, target_, context_);
    std::vector<GlobalCandidate> candidates;
    for (const Hypothesis& one :
         hypotheses_of(matches, kBound * cell_, place_, kHypotheses, context_))
      candidates.push_back({one.pose, one.inliers, judge.agreement(one.pose, kFewPoints)});
    sort(candidates);
    if (candidates.size() > kFinalists) candidates.resize(kFinalists);
    settle(judge, candidates, 0);
    if (!candidates.empty()) {
      const std::size_t found = candidates.size();
      add_turned(candidates);
      settle(judge, candidates, found);
    }
    result_.candidates = static_cast<Index>(candidates.size());
    if (!candidates.empty()) finish(judge, candidates, matches);
    explain();
    return std::move(result_);
  }

 private:
  static void sort(std::vector<GlobalCandidate>& candidates) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const GlobalCandidate& a, const GlobalCandidate& b) {
                       return a.seen.evidence > b.seen.evidence;
                     });
  }

  void settle(const Judge& judge, std::vector<GlobalCandidate>& candidates, std::size_t first) {
    for (std::size_t i = first; i < candidates.size(); ++i) {
      GlobalCandidate& one = candidates[i];
      one.pose = judge.refine(one.pose, 3.0 * cell_, cell_, kSomePoints).pose;
      one.seen = judge.agreement(one.pose, source_.cloud.size());
    }
    sort(candidates);
  }

  /// The best pose turned by quarters about the target's principal axes: a scene that fits itself
  /// so must not be registered as if it had one pose only.
  void add_turned(std::vector<GlobalCandidate>& candidates) const {
    const Pose best = candidates.front().pose;
    const auto points = source_.cloud.positions();
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (Index i = 0; i < points.cols(); ++i) {
      const Eigen::Vector3d p = points.col(i).cast<double>() - place_;
      spread += p * p.transpose();
    }
    const geometry::Eigen3 axes = geometry::eigen3(spread);
    for (int axis = 0; axis < 3; ++axis)
      for (int quarter = 1; quarter <= 3; ++quarter) {
        Pose turned = best;
        turned.linear() = best.linear() * Eigen::AngleAxisd(0.5 * std::numbers::pi * quarter,
                                                            axes.vectors.col(axis))
                                              .toRotationMatrix();
        turned.translation() += best.linear() * place_ - turned.linear() * place_;
        candidates.push_back({turned, 0, {}});
      }
  }

  void finish(const Judge& judge, const std::vector<GlobalCandidate>& candidates,
              const std::vector<Match>& matches) {
    const GlobalCandidate& best = candidates.front();
    JudgeRefined refined = judge.refine(best.pose, cell_, 0.7 * cell_, source_.cloud.size());
    result_.pose = refined.pose;
    result_.steps = std::move(refined.steps);
    result_.inliers = inliers_of(matches, refined.pose, kBound * cell_);
    result_.seen = judge.agreement(refined.pose, source_.cloud.size());
    result_.weakest = refined.equations.directions(refined.radius).strength[0];
    result_.deviations =
        refined.equations.deviations(refined.radius, std::sqrt(refined.equations.mean_square()));
    compare(judge, candidates);
  }

  /// The best pose beside the next one: by how much it explains more, and whether there is much
  /// that only the other one explains. A floor lies on a floor in many ways, yet a pose that
  /// explains the floor and all that stands on it is not in doubt.
  void compare(const Judge& judge, const std::vector<GlobalCandidate>& candidates) {
    const GlobalCandidate& best = candidates.front();
    const auto next =
        std::find_if(candidates.begin(), candidates.end(), [&](const GlobalCandidate& other) {
          return !same_motion(best.pose, other.pose, place_, kBound * cell_);
        });
    result_.gap = 1.0;
    result_.dominance = 1.0;
    if (next == candidates.end() || !(best.seen.evidence > 0.0)) return;
    result_.gap = 1.0 - next->seen.evidence / best.seen.evidence;
    const std::vector<float> a = judge.borne_out(best.pose);
    const std::vector<float> b = judge.borne_out(next->pose);
    double only_best = 0.0;
    double only_next = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      only_best += std::max(0.0F, a[i] - b[i]);
      only_next += std::max(0.0F, b[i] - a[i]);
    }
    result_.dominance = (only_best - only_next) / std::max(only_best + only_next, 1e-9);
  }

  void explain() {
    if (result_.candidates == 0) {
      result_.refusal = fmt::format(
          "no motion is borne out: of {} pairs of features no four agree on one", result_.matches);
      result_.hint = "the surfaces may be too plain; pick pairs for registration.svd";
    } else if (result_.inliers < options_.least_matches) {
      result_.refusal =
          fmt::format("only {} of {} pairs of features agree on the best motion, {} are needed",
                      result_.inliers, result_.matches, options_.least_matches);
      result_.hint = "the clouds may share too little, or nothing that stands out";
    } else if (result_.seen.share < options_.least_overlap) {
      result_.refusal = fmt::format(
          "at the best motion {:.1f} % of the smaller cloud lies on the other, {:.1f} % is needed",
          100.0 * result_.seen.share, 100.0 * options_.least_overlap);
      result_.hint = "lower min_overlap only where so little is really common";
    } else if (!(result_.weakest > kFree)) {
      result_.refusal = "the common surface slides on itself: a direction of the pose is free";
      result_.hint =
          "a plane, sphere, cylinder or the like fixes no pose; add what stands beside it";
    } else if (!clear()) {
      result_.refusal = fmt::format(
          "two motions fit nearly as well: the second has {:.0f} % of the evidence of the best",
          100.0 * (1.0 - result_.gap));
      result_.hint = "the scene looks the same from another side; pick pairs for registration.svd";
    }
  }

  [[nodiscard]] bool clear() const {
    return result_.gap >= options_.least_gap ||
           (result_.gap >= kClearGap * options_.least_gap && result_.dominance >= kDominant);
  }

  const GlobalOptions& options_;
  Context& context_;
  Sampled source_;
  Sampled target_;
  double cell_ = 0.0;
  Eigen::Vector3d place_;
  GlobalResult result_;
};

}  // namespace

GlobalResult try_globally(const Cloud& source, const Cloud& target, double cell,
                          const GlobalOptions& options, Context& context) {
  return Attempt(source, target, cell, options, context).run();
}

}  // namespace velum::registration
