// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "registration/icp.hpp"
#include "velum/values.hpp"

namespace velum::registration {

/// A registration that a library does in single precision, brought near its origin and back, and
/// reported as our own.
class Borrowed {
 public:
  /// Throws Error when a cloud has fewer than `least` points. `what` names the method in messages.
  Borrowed(std::string what, const Cloud& source, const Cloud& target,
           const std::optional<Transform>& initial, Index least);

  /// The clouds for the library, both about the target's middle, the source at the start pose.
  [[nodiscard]] const Cloud& source() const { return source_; }
  [[nodiscard]] const Cloud& target() const { return target_; }

  /// To be called after each of the library's iterations with the source as it lies now. `error` is
  /// the mean squared distance of `pairs` pairs [m²], NaN where the library does not say. Throws
  /// Cancelled on interruption and Error when the points are no longer finite.
  void iteration(const ConstPoints& moved, Index pairs, double error, Context& context);
  [[nodiscard]] int iterations() const { return static_cast<int>(steps_.size()); }

  /// The outputs of the stage for the motion that the library found, and its measures; warns unless
  /// `converged`. Throws Error when the motion is none, or nothing is within `max_distance` after
  /// it.
  std::tuple<Cloud, Transform, Table> finish(const Eigen::Matrix4d& motion, double max_distance,
                                             bool converged, Context& context) const;

 private:
  std::string what_;
  Cloud given_;
  Pose initial_ = Pose::Identity();
  Cloud source_;
  Cloud target_;
  Eigen::Matrix3Xd before_;  ///< some of the source's points after the last iteration
  std::vector<IcpStep> steps_;
};

}  // namespace velum::registration
