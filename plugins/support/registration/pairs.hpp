// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

#include "velum/cloud.hpp"
#include "velum/context.hpp"

namespace velum::registration {

/// The closest target point of every source point while the source moves, kept up to date from one
/// pose to the next. A match is searched again only where the motion since the last search could
/// have changed it: the match stays the closest while it is nearer than the second one can have
/// become. A search starts from the last match, and from that of the point before, as a bound. The
/// matches are exactly those of a full search.
///
/// The source points are numbered along a curve (along_curve), not as they were given: original(i)
/// leads back.
class ClosestPairs {
 public:
  /// Source points in their own frame; the target is shared.
  ClosestPairs(const Eigen::Ref<const Points>& source, const Cloud& target);

  /// Matches under `pose` (source frame → target's, both relative to their origins); those farther
  /// than `max_distance` [m] do not count.
  void update(const Pose& pose, double max_distance, Context& context);

  [[nodiscard]] Index size() const { return source_.cols(); }
  /// Column of the source as it was given that is now point i.
  [[nodiscard]] std::int32_t original(Index i) const {
    return original_[static_cast<std::size_t>(i)];
  }
  /// Source points in this class's order, in their own frame.
  [[nodiscard]] const Points& source() const { return source_; }
  /// Target point of source point i, -1 where there is none near enough.
  [[nodiscard]] std::int32_t match(Index i) const {
    const auto at = static_cast<std::size_t>(i);
    return distance_[at] <= max_distance_ ? match_[at] : -1;
  }
  /// Distance to it [m].
  [[nodiscard]] double distance(Index i) const { return distance_[static_cast<std::size_t>(i)]; }
  /// Position of the match of i, where it has one.
  [[nodiscard]] Eigen::Vector3d matched(Index i) const { return there_.col(i).cast<double>(); }
  /// Source point i under the last pose.
  [[nodiscard]] Eigen::Vector3d moved(Index i) const {
    return pose_ * source_.col(i).cast<double>();
  }
  [[nodiscard]] const Pose& pose() const { return pose_; }
  [[nodiscard]] Eigen::Vector3d target(std::int32_t match) const {
    return target_.positions().col(match).cast<double>();
  }
  /// How many of the last update's matches had to be searched.
  [[nodiscard]] Index searched() const { return searched_; }
  /// How many points have a match near enough.
  [[nodiscard]] Index count() const;

 private:
  [[nodiscard]] bool keeps_match(Index i, const Eigen::Vector3f& now);
  void search_one(Index i, const Eigen::Vector3f& now, Index hint);
  void search_two(Index i, const Eigen::Vector3f& now, std::vector<Neighbour>& found);
  void set(Index i, const Neighbour& nearest, float second);
  [[nodiscard]] double farthest_step(const Pose& pose) const;

  std::vector<std::int32_t> original_;
  Points source_;
  Cloud target_;
  Eigen::AlignedBox3d box_;  ///< of the source
  Pose pose_ = Pose::Identity();
  double max_distance_ = std::numeric_limits<double>::infinity();
  Points searched_at_;  ///< where each point was when it was last searched
  Points there_;        ///< positions of the matches
  std::vector<std::int32_t> match_;
  std::vector<float> first_;     ///< distance to the match at that search, or less
  std::vector<float> second_;    ///< and to the second closest, or less
  std::vector<float> distance_;  ///< to the match now
  Index searched_ = 0;
};

}  // namespace velum::registration
