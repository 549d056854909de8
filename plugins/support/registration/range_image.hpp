// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "velum/types.hpp"

namespace velum::registration {

/// What a scanner saw in each direction: the nearest range in each pixel of a cube around it, so
/// that a place can be asked for whether the scanner looked through it.
class RangeImage {
 public:
  enum class Sight {
    unknown,  ///< not looked at, or behind what was seen
    agrees,   ///< where the scanner saw something that is no plane of the room
    blocked   ///< in front of all that the scanner saw there: nothing can be there
  };

  /// `points` relative to `eye` [m]; `is_rest` says which are on none of the room's planes.
  RangeImage(const Eigen::Matrix3Xf& points, const std::vector<char>& is_rest);

  /// `point` relative to the eye; places nearer than `margin` [m] to what was seen are not blocked.
  [[nodiscard]] Sight look(const Eigen::Vector3f& point, float margin) const;

 private:
  [[nodiscard]] bool fill(const Eigen::Matrix3Xf& points, const std::vector<char>& is_rest);

  int side_ = 0;
  std::vector<float> nearest_;       ///< of all points; infinity where there are none
  std::vector<float> nearest_rest_;  ///< of the rest
  std::vector<float> farthest_rest_;
};

}  // namespace velum::registration
