// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/cloud.hpp>

namespace velum::meshing {

/// Positions in the plane that fits them best (principal components) [m].
Eigen::Matrix2Xd project_best_fit(const ConstPoints& positions);

/// Positions as the angles (α, γ) under which `sensor` sees them [rad] (thesis Algorithm 3.8),
/// about the direction to their middle, so that the seam of the angles lies behind the sensor.
Eigen::Matrix2Xd project_spherical(const ConstPoints& positions, const Eigen::Vector3f& sensor);

/// The sensor that saw most points; empty when the cloud has none.
std::optional<std::size_t> main_sensor(const Cloud& cloud);

}  // namespace velum::meshing
