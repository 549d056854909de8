// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "velum/types.hpp"

namespace velum::picture {

/// A parallel projection, so that lengths in the picture are true to scale.
struct Camera {
  Eigen::Matrix3f axes = Eigen::Matrix3f::Identity();  ///< rows: right, up, towards the viewer
  Eigen::Vector2f middle = Eigen::Vector2f::Zero();    ///< of the picture, along right and up [m]
  float pixels = 1.0F;                                 ///< of a metre
};

/// Looks at the positions with z up: from the side on which the eyes (scanners) stand when they
/// stand outside, else from the broad side of what is flat, and obliquely from above on the rest.
/// All but a few stray positions fill a picture of this size.
[[nodiscard]] Camera look_at(const ConstPoints& positions, const std::vector<Eigen::Vector3f>& eyes,
                             int width, int height);

}  // namespace velum::picture
