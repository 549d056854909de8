// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "registration/icp.hpp"
#include "registration/pairs.hpp"

namespace velum::registration {

/// A pair of points and what the metric makes of it: the source point should move by `gap` along
/// `normal`, the motion being taken `at` a place on or between the two.
struct Pair {
  Eigen::Vector3d point;   ///< of the source, under the pose
  Eigen::Vector3d target;  ///< its match
  Eigen::Vector3d at;
  Eigen::Vector3d normal;
  double gap = 0.0;  ///< [m]; the distance where the metric is point to point
  double weight = 0.0;
};

/// The pairs of a source under a pose that count, and for how much: near enough, with normals that
/// fit, mutual, among the share that is kept, weighed by the kernel.
class WeighedPairs {
 public:
  /// Source and target must have the columns that the options ask for; Error otherwise.
  WeighedPairs(const Cloud& source, const Cloud& target, const IcpOptions& options);

  void update(const Pose& pose, Context& context);

  [[nodiscard]] Index size() const { return pairs_.size(); }
  [[nodiscard]] const ClosestPairs& closest() const { return pairs_; }
  /// The pair of source point i; false where it does not count.
  bool get(Index i, Pair& pair) const;
  [[nodiscard]] const Cloud& target() const { return target_; }
  /// Gaps are distances along normals, not of points.
  [[nodiscard]] bool planar() const { return options_.metric != Metric::point_to_point; }
  /// One standard deviation by which the kernel weighs [m]; 0 without one.
  [[nodiscard]] double scale() const { return scale_; }

 private:
  bool build(Index i, Pair& pair) const;
  [[nodiscard]] bool mutual(Index i, const Pair& pair) const;
  [[nodiscard]] double weight_of(double gap) const;
  void fetch_normals(Context& context);
  void find_limits(Context& context);

  Cloud target_;
  IcpOptions options_;
  ClosestPairs pairs_;
  std::optional<Cloud> mutual_source_;  ///< in the order of pairs_, to search back
  std::optional<ConstPoints> target_normals_;
  Points source_normals_;                ///< in the order of pairs_
  Points normals_;                       ///< of the matches
  std::vector<std::int32_t> normal_of_;  ///< target point of each of these
  double least_cosine_ = -1.0;
  std::vector<float> gaps_;  ///< NaN where there is no pair; empty where nobody asks
  double limit_ = std::numeric_limits<double>::infinity();
  double scale_ = 0.0;
};

}  // namespace velum::registration
