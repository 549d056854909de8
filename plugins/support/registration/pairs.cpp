// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "registration/pairs.hpp"

#include <cmath>
#include <utility>

namespace velum::registration {
namespace {

constexpr Index kGrain = 4096;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Room for rounding of single-precision distances in the test that spares a search.
constexpr float kSlack = 1e-5F;

}  // namespace

ClosestPairs::ClosestPairs(Points source, const Cloud& target)
    : source_(std::move(source)), target_(target), searched_at_(Points::Zero(3, source_.cols())) {
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
  if (match_[at] < 0) return false;
  const float gone = (now - searched_at_.col(i)).norm();
  const float distance = (now - target_.positions().col(match_[at])).norm();
  distance_[at] = distance;
  const float slack = kSlack * (distance + gone + second_[at]);
  if (distance + gone + slack < second_[at]) return true;
  // Still too far from everything: the match may be another, but it does not count either way.
  return static_cast<double>(first_[at] - gone - slack) > max_distance_;
}

void ClosestPairs::search(const std::vector<std::int32_t>& which, Context& context) {
  const Neighbours& neighbours = target_.neighbours();
  // One by one: while the clouds are apart, the points around a match are far more than those near
  // it, which is what the answers for many queries at once are made for.
  parallel_for(context, static_cast<Index>(which.size()), kGrain / 4, [&](Index begin, Index end) {
    std::vector<Neighbour> found;
    for (Index k = begin; k < end; ++k) {
      const std::int32_t point = which[static_cast<std::size_t>(k)];
      const Eigen::Vector3f now = moved(point).cast<float>();
      searched_at_.col(point) = now;
      neighbours.nearest(now, 2, found);
      if (found.empty()) continue;
      const auto at = static_cast<std::size_t>(point);
      match_[at] = found[0].index;
      first_[at] = std::sqrt(found[0].distance2);
      second_[at] = found.size() > 1 ? std::sqrt(found[1].distance2) : kInfinity;
      distance_[at] = first_[at];
    }
  });
}

void ClosestPairs::update(const Pose& pose, double max_distance, Context& context) {
  pose_ = pose;
  max_distance_ = max_distance;
  const Index n = size();
  std::vector<std::vector<std::int32_t>> stale(static_cast<std::size_t>((n + kGrain - 1) / kGrain));
  parallel_for(context, n, kGrain, [&](Index begin, Index end) {
    auto& mine = stale[static_cast<std::size_t>(begin / kGrain)];
    for (Index i = begin; i < end; ++i)
      if (!keeps_match(i, moved(i).cast<float>())) mine.push_back(static_cast<std::int32_t>(i));
  });
  std::vector<std::int32_t> all;
  for (const auto& part : stale) all.insert(all.end(), part.begin(), part.end());
  searched_ = static_cast<Index>(all.size());
  if (!all.empty()) search(all, context);
}

}  // namespace velum::registration
