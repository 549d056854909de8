// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/register_planes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "registration/plane_refine.hpp"

namespace velum::registration {
namespace {

/// Candidates that are refined before the choice.
constexpr std::size_t kFinalists = 8;
/// Points of the rest used to refine a finalist, and the winner.
constexpr Index kFewPoints = 2000;
constexpr Index kManyPoints = 40000;
/// Poses nearer than this are one: turn [rad], and shift in margins.
constexpr double kSameTurn = 0.05;
constexpr double kSameShift = 3.0;
/// More of the rest than this in places that the other scanner looked through: not the same scene.
constexpr double kMostBlocked = 0.2;
constexpr Index kCoarseStride = 4;
constexpr Index kSlideStride = 16;
/// Evidence for a pose that all planes fix together, above which poses that slide are not looked
/// at.
constexpr double kPlain = 0.2;

struct Candidate {
  Assignment assignment;
  Evidence seen;
  double score = 0.0;
};

class PlaneRegistration {
 public:
  PlaneRegistration(const Cloud& source, const Cloud& target, const PlanesOptions& options,
                    Context& context)
      : options_(options), context_(context) {
    parallel_for(context, 2, 1, [&](Index begin, Index) {
      geometry::PlaneSearch search;
      search.cell = options.cell;
      (begin == 0 ? source_ : target_) = prepare(begin == 0 ? source : target, search, context);
    });
    margin_ = 2.0 * std::max({source_.fine, target_.fine, 0.25 * source_.scene.cell});
  }

  PlanesResult run() {
    require_planes();
    context_.progress(0.3);
    std::vector<Candidate> candidates = place();
    const auto count = static_cast<int>(candidates.size());
    candidates = finalists(std::move(candidates));
    context_.progress(0.6);
    const Candidate& best = candidates.front();
    PlanesResult result;
    result.candidates = count;
    result.gap = gap_to_next(candidates);
    require_choice(best, result.gap);
    finish(best, result);
    return result;
  }

 private:
  void require_planes() const {
    for (const auto& [scan, name] :
         {std::pair(&source_, "source"), std::pair(&target_, "target")}) {
      const auto& planes = scan->scene.planes;
      const bool spans = std::any_of(planes.begin(), planes.end(), [&](const auto& plane) {
        return std::abs(plane.fit.normal.dot(planes.front().fit.normal)) < 0.94;
      });
      if (!spans)
        throw Error(Fault::stage,
                    fmt::format("the {} shows {} plane{}{}; two that are not parallel are needed",
                                name, planes.size(), planes.size() == 1 ? "" : "s",
                                planes.size() > 1 ? ", all parallel" : ""))
            .hint(
                "scenes without walls are registered by registration.svd from picked points, then "
                "registration.icp");
    }
  }

  /// The plane that a picked point lies on.
  [[nodiscard]] static int picked(const RoomScan& scan, const Eigen::Vector3d& point,
                                  const char* name) {
    const Eigen::Vector3f local = (point - scan.cloud.origin()).cast<float>();
    const Neighbour nearest =
        scan.cloud.neighbours().nearest_one(local, 3.0 * std::max(scan.scene.cell, 1e-30));
    const int plane =
        nearest.index < 0 ? -1 : scan.scene.plane_of[static_cast<std::size_t>(nearest.index)];
    if (plane < 0)
      throw Error(
          Fault::stage,
          fmt::format("the picked point ({:.6g}, {:.6g}, {:.6g}) lies on no plane of the {}",
                      point.x(), point.y(), point.z(), name));
    return plane;
  }

  /// All assignments with their full poses, and what speaks for each.
  std::vector<Candidate> place() {
    MatchOptions match;
    match.offset = 0.5 * std::max(source_.scene.cell, target_.scene.cell);
    for (const PlanePick& pick : options_.picks)
      match.picks.push_back(
          {picked(source_, pick.source, "source"), picked(target_, pick.target, "target")});
    std::vector<Candidate> candidates;
    std::vector<Assignment> sliding;
    for (Assignment& one : match_planes(source_.scene.planes, target_.scene.planes, match)) {
      if (one.free.empty())
        candidates.push_back({std::move(one), {}, 0.0});
      else
        sliding.push_back(std::move(one));
    }
    const bool plain = std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& one) {
      return evidence(source_, target_, one.assignment.pose, margin_, kCoarseStride).total() >
             kPlain;
    });
    if (!plain)
      for (const Assignment& one : sliding) slide(one, candidates);
    if (candidates.empty())
      throw Error(Fault::stage,
                  fmt::format("no assignment of the source's {} planes to the target's "
                              "{} makes them coincide",
                              source_.scene.planes.size(), target_.scene.planes.size()));
    double most = 0.0;
    for (const Candidate& one : candidates) most = std::max(most, one.assignment.support);
    // Poses that slide are right to a step only.
    for (Candidate& one : candidates) judge(one, most, 2.0 * margin_, kCoarseStride);
    sort(candidates);
    return candidates;
  }

  void judge(Candidate& one, double most, double margin, Index stride) const {
    one.seen = evidence(source_, target_, one.assignment.pose, margin, stride);
    one.score = 0.5 * one.assignment.support / most + one.seen.total();
  }

  static void sort(std::vector<Candidate>& candidates) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  }

  /// Along the direction that the planes leave free, the rest of the scene decides: the two best
  /// places.
  void slide(const Assignment& one, std::vector<Candidate>& out) const {
    context_.check();
    if (source_.rest_thin.cols() == 0 || target_.rest_thin.cols() == 0) return;
    const Eigen::Vector3d axis = one.free.front();
    const Eigen::RowVector3f along = axis.transpose().cast<float>();
    const Eigen::RowVectorXf there = along * target_.rest_thin;
    const Eigen::RowVectorXf here = along * (one.pose.linear().cast<float>() * source_.rest_thin);
    const double start = static_cast<double>(there.minCoeff() - here.maxCoeff());
    const double end = static_cast<double>(there.maxCoeff() - here.minCoeff());
    const double offset = axis.dot(one.pose.translation());
    const double step = 2.0 * margin_;
    const auto steps = static_cast<Index>(std::min(2000.0, std::ceil((end - start) / step)));
    std::vector<double> scores(static_cast<std::size_t>(steps) + 1);
    const auto pose_at = [&](Index k) {
      Pose pose = one.pose;
      pose.translation() += axis * (start +
                                    (end - start) * static_cast<double>(k) /
                                        static_cast<double>(std::max<Index>(1, steps)) -
                                    offset);
      return pose;
    };
    parallel_for(context_, steps + 1, 8, [&](Index begin, Index stop) {
      for (Index k = begin; k < stop; ++k)
        scores[static_cast<std::size_t>(k)] =
            evidence(source_, target_, pose_at(k), step, kSlideStride).total();
    });
    for (int peak = 0; peak < 2; ++peak) {
      const auto best = std::max_element(scores.begin(), scores.end());
      if (!(*best > -1e300)) return;
      const Index k = best - scores.begin();
      out.push_back({one, {}, 0.0});
      out.back().assignment.pose = pose_at(k);
      for (Index near = std::max<Index>(0, k - 3); near <= std::min(steps, k + 3); ++near)
        scores[static_cast<std::size_t>(near)] = -std::numeric_limits<double>::infinity();
    }
  }

  /// The best ones, each refined on a few points and judged on all.
  std::vector<Candidate> finalists(std::vector<Candidate> candidates) {
    if (candidates.size() > kFinalists) candidates.resize(kFinalists);
    rest_ = make_rest(source_, target_, kManyPoints, context_);
    RestPair few{rest_.source, rest_.target};
    const Index stride = std::max<Index>(1, rest_.source.cols() / kFewPoints);
    few.source.resize(3, rest_.source.cols() / stride);
    for (Index i = 0; i < few.source.cols(); ++i) few.source.col(i) = rest_.source.col(i * stride);
    double most = 0.0;
    for (const Candidate& one : candidates) most = std::max(most, one.assignment.support);
    for (Candidate& one : candidates) {
      one.assignment.pose =
          refine(source_, target_, few, one.assignment, 2.0 * margin_, 0.5 * margin_, context_)
              .pose;
      judge(one, most, margin_, 1);
    }
    sort(candidates);
    return candidates;
  }

  [[nodiscard]] double gap_to_next(const std::vector<Candidate>& candidates) const {
    const Candidate& best = candidates.front();
    for (const Candidate& other : candidates) {
      const auto apart = geometry::difference(best.assignment.pose, other.assignment.pose,
                                              source_.eyes.front().position);
      if (apart.rotation > kSameTurn || apart.translation > kSameShift * margin_)
        return best.score - other.score;
    }
    return best.score;
  }

  void require_choice(const Candidate& best, double gap) const {
    if (gap < options_.least_gap)
      throw Error(
          Fault::stage,
          fmt::format("two poses fit the planes, and the rest of the scene does not tell them "
                      "apart: the evidence differs by {:.3f}, {:.3f} is needed",
                      gap, options_.least_gap))
          .hint("pick two matching planes with `picks`, or scan more of what stands in the room");
    if (best.seen.blocked > kMostBlocked || best.seen.walls_blocked > kMostBlocked)
      throw Error(
          Fault::stage,
          fmt::format("no pose fits: at the best one {:.0f} % of what stands in the room and "
                      "{:.0f} % of its walls lie where the other scanner looked through",
                      100.0 * best.seen.blocked, 100.0 * best.seen.walls_blocked))
          .hint("the scans may be of different scenes, or something large was moved between them");
  }

  void finish(const Candidate& best, PlanesResult& result) {
    const double last = std::clamp(3.0 * rest_.target.spacing(), 0.25 * margin_, 0.5 * margin_);
    Refined refined =
        refine(source_, target_, rest_, best.assignment, 0.5 * margin_, last, context_);
    result.pose = refined.pose;
    result.steps = std::move(refined.steps);
    result.matched = static_cast<int>(best.assignment.matches.size());
    result.agrees = best.seen.agrees;
    result.blocked = best.seen.blocked;
    result.sigma = refined.sigma;
    result.plane_gap = refined.plane_gap;
    result.deviations = refined.equations.deviations(refined.radius, refined.sigma);
    result.weakest = refined.equations.directions(refined.radius).axes.col(0);
    measure_overlap(result);
    require_quality(result);
  }

  void measure_overlap(PlanesResult& result) const {
    const double radius = 2.0 * std::max(source_.scene.cell, target_.scene.cell);
    const auto positions = source_.cloud.positions();
    const Neighbours& neighbours = target_.cloud.neighbours();
    using Sum = std::pair<double, Index>;
    const Sum sum = parallel_reduce(
        context_, positions.cols(), 2048, Sum(0.0, 0),
        [&](Index begin, Index end) {
          Sum mine(0.0, 0);
          for (Index i = begin; i < end; ++i) {
            const Eigen::Vector3d p = result.pose * positions.col(i).cast<double>();
            const Neighbour near = neighbours.nearest_one(p.cast<float>(), radius);
            if (near.index < 0) continue;
            mine.first += static_cast<double>(near.distance2);
            ++mine.second;
          }
          return mine;
        },
        [](Sum& total, const Sum& one) {
          total.first += one.first;
          total.second += one.second;
        });
    result.fitness = sum.second > 0 ? sum.first / static_cast<double>(sum.second) : 0.0;
    result.overlap = static_cast<double>(sum.second) / static_cast<double>(positions.cols());
  }

  void require_quality(const PlanesResult& result) const {
    if (result.overlap < options_.least_overlap)
      throw Error(Fault::stage,
                  fmt::format("{:.1f} % of the source lies near the target, {:.1f} % are needed",
                              100.0 * result.overlap, 100.0 * options_.least_overlap));
    if (result.plane_gap > 0.5 * std::max(source_.scene.cell, target_.scene.cell))
      throw Error(Fault::stage,
                  fmt::format("the matched planes stay {:.4g} m apart", result.plane_gap));
    if (options_.most_deviation > 0.0 && !(result.deviations.translation < options_.most_deviation))
      throw Error(
          Fault::stage,
          fmt::format("the pose is not fixed: {} is known to {:.3g} m only, {:.3g} m is asked",
                      describe_direction(result.weakest), result.deviations.translation,
                      options_.most_deviation))
          .hint("the scans need a common surface that faces this direction");
  }

  const PlanesOptions& options_;
  Context& context_;
  RoomScan source_;
  RoomScan target_;
  RestPair rest_;
  double margin_ = 0.0;
};

}  // namespace

PlanesResult register_planes(const Cloud& source, const Cloud& target, const PlanesOptions& options,
                             Context& context) {
  for (const auto& [cloud, name] : {std::pair(&source, "source"), std::pair(&target, "target")})
    if (cloud->empty()) throw Error(Fault::stage, fmt::format("the {} has no points", name));
  return PlaneRegistration(source, target, options, context).run();
}

}  // namespace velum::registration
