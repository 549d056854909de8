// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/pairs.hpp"

#include <cmath>

#include "registration/along_curve.hpp"

namespace velum::registration {
namespace {

constexpr Index kGrain = 4096;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Room for rounding of single-precision distances in the test that spares a search.
constexpr float kSlack = 1e-5F;
/// The same for a known distance as the limit of a search.
constexpr double kRoom = 1e-6;
/// No search goes farther than this many times the distance that counts: far enough that it need
/// not be repeated at the next step.
constexpr double kFar = 2.0;
/// Below this share of the target's spacing, steps are short enough that knowing the second closest
/// spares searches.
constexpr double kShortStep = 0.2;

float squared_distance(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return (a - b).squaredNorm();
}

}  // namespace

ClosestPairs::ClosestPairs(const Eigen::Ref<const Points>& source, const Cloud& target)
    : original_(along_curve(source)),
      source_(3, source.cols()),
      target_(target),
      searched_at_(Points::Zero(3, source.cols())),
      there_(Points::Zero(3, source.cols())) {
  for (Index i = 0; i < source_.cols(); ++i) {
    source_.col(i) = source.col(original(i));
    box_.extend(source_.col(i).cast<double>());
  }
  const auto n = static_cast<std::size_t>(source_.cols());
  match_.assign(n, -1);
  first_.assign(n, 0.0F);
  second_.assign(n, -kInfinity);  // nothing known: search
  distance_.assign(n, kInfinity);
}

Index ClosestPairs::count() const {
  Index n = 0;
  for (Index i = 0; i < size(); ++i) n += match(i) >= 0 ? 1 : 0;
  return n;
}

bool ClosestPairs::keeps_match(Index i, const Eigen::Vector3f& now) {
  const auto at = static_cast<std::size_t>(i);
  const float gone = (now - searched_at_.col(i)).norm();
  if (match_[at] >= 0) {
    const float distance = (now - there_.col(i)).norm();
    distance_[at] = distance;
    if (distance + gone + kSlack * (distance + gone + second_[at]) < second_[at]) return true;
  }
  // Still too far from everything: the match may be another, but it does not count either way.
  const float slack = kSlack * (gone + first_[at]);
  return static_cast<double>(first_[at] - gone - slack) > max_distance_;
}

void ClosestPairs::set(Index i, const Neighbour& nearest, float second) {
  const auto at = static_cast<std::size_t>(i);
  if (nearest.index >= 0 && match_[at] != nearest.index)
    there_.col(i) = target_.positions().col(nearest.index);
  match_[at] = nearest.index;
  first_[at] = nearest.index >= 0 ? std::sqrt(nearest.distance2) : second;
  second_[at] = nearest.index >= 0 ? second : kInfinity;
  distance_[at] = nearest.index >= 0 ? first_[at] : kInfinity;
}

/// The closest alone. `hint` is another point, whose match bounds the search too.
void ClosestPairs::search_one(Index i, const Eigen::Vector3f& now, Index hint) {
  float known2 = kInfinity;
  for (const Index known : {i, hint})
    if (match_[static_cast<std::size_t>(known)] >= 0)
      known2 = std::min(known2, squared_distance(now, there_.col(known)));
  const double far = kFar * max_distance_;
  // Not zero, or the search for a point in the very place would find nothing.
  const double known = std::sqrt(static_cast<double>(known2)) * (1.0 + kRoom) + 1e-30;
  const Neighbour found = target_.neighbours().nearest_one(now, std::min(known, far));
  set(i, found,
      found.index >= 0 ? std::sqrt(found.distance2) : static_cast<float>(far * (1.0 - kRoom)));
}

void ClosestPairs::search_two(Index i, const Eigen::Vector3f& now, std::vector<Neighbour>& found) {
  target_.neighbours().nearest(now, 2, found);
  if (found.empty()) return;
  set(i, found[0], found.size() > 1 ? std::sqrt(found[1].distance2) : kInfinity);
}

/// How far the change to `pose` moves any source point, at most [m].
double ClosestPairs::farthest_step(const Pose& pose) const {
  double farthest = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d at = box_.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
    farthest = std::max(farthest, (pose * at - pose_ * at).norm());
  }
  return farthest;
}

void ClosestPairs::update(const Pose& pose, double max_distance, Context& context) {
  const Index n = size();
  if (n == 0 || target_.empty()) return;
  const bool short_step = farthest_step(pose) < kShortStep * target_.spacing();
  pose_ = pose;
  max_distance_ = max_distance;
  std::vector<Index> searched(static_cast<std::size_t>((n + kGrain - 1) / kGrain), 0);
  parallel_for(context, n, kGrain, [&](Index begin, Index end) {
    std::vector<Neighbour> found;
    Index& mine = searched[static_cast<std::size_t>(begin / kGrain)];
    for (Index i = begin; i < end; ++i) {
      const Eigen::Vector3f now = moved(i).cast<float>();
      if (keeps_match(i, now)) continue;
      ++mine;
      searched_at_.col(i) = now;
      if (short_step && match(i) >= 0) {
        search_two(i, now, found);
      } else {
        search_one(i, now, std::max(begin, i - 1));
      }
    }
  });
  searched_ = 0;
  for (const Index part : searched) searched_ += part;
}

}  // namespace velum::registration
