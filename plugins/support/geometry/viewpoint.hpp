// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>
#include <velum/cloud.hpp>

namespace velum::geometry {

/// From where each point of a cloud was seen: its sensor, or in a cloud without sensors the origin
/// of the axes (thesis 3.1.3). The cloud must outlive it.
class Viewpoints {
 public:
  explicit Viewpoints(const Cloud& cloud) : cloud_(cloud), positions_(cloud.positions()) {
    for (std::size_t i = 0; i < cloud.sensors().size(); ++i)
      places_.push_back(cloud.sensor_position(i));
    if (places_.empty()) places_.emplace_back((-cloud.origin()).cast<float>());
  }

  /// The way from the point to where it was seen from [m], not normalised.
  [[nodiscard]] Eigen::Vector3d from(Index point) const {
    const Eigen::Vector3f place = places_[cloud_.sensor_of(point).value_or(0)];
    return (place - positions_.col(point)).cast<double>();
  }

 private:
  const Cloud& cloud_;
  ConstPoints positions_;
  std::vector<Eigen::Vector3f> places_;
};

}  // namespace velum::geometry
