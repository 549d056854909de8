// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "global/sampled.hpp"
#include "registration/icp.hpp"

namespace velum::registration {

/// How well two sampled clouds lie on each other.
struct Agreement {
  double share = 0.0;    ///< of the smaller cloud that lies on the other, nearness weighted, 0 to 1
  double overlap = 0.0;  ///< of the source that has a point of the target near by
  double fitness = 0.0;  ///< mean squared distance of these [m²]
  double evidence = 0.0;  ///< as share, of the source, points counted by how rare they look
};

struct JudgeRefined {
  Pose pose = Pose::Identity();
  NormalEquations equations{Eigen::Vector3d::Zero()};  ///< at the end
  double radius = 1.0;                                 ///< of the pairs, for turns [m]
  std::vector<IcpStep> steps;
};

/// Asks the clouds themselves about a pose (source → target, relative to their origins).
class Judge {
 public:
  Judge(const Sampled& source, const Sampled& target, Context& context);

  /// Over at most `most` source points.
  [[nodiscard]] Agreement agreement(const Pose& pose, Index most) const;
  /// What each source point adds to the evidence, 0 to 1.
  [[nodiscard]] std::vector<float> borne_out(const Pose& pose) const;
  /// Point to plane over at most `most` source points within a distance that shrinks from `first`
  /// to `last` [m], pairs that disagree weighted down.
  [[nodiscard]] JudgeRefined refine(const Pose& pose, double first, double last, Index most) const;

 private:
  struct Near {
    std::int32_t index = -1;
    double distance = 0.0;
    double gap = 0.0;  ///< along the target's normal
  };
  [[nodiscard]] Near near(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                          double reach) const;
  [[nodiscard]] double weight(const Near& found) const;
  /// Of a source point that lies on the target: as much as the more common of both is rare.
  [[nodiscard]] double rarity(Index source, const Near& found) const;
  [[nodiscard]] NormalEquations equations(const Pose& pose, double reach, Index stride,
                                          double& radius, Index& pairs) const;

  const Sampled& source_;
  const Sampled& target_;
  Context& context_;
  double cell_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
};

}  // namespace velum::registration
