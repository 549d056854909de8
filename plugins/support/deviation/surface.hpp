// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <velum/cloud.hpp>
#include <velum/context.hpp>
#include <velum/table.hpp>

namespace velum::deviation {

/// `cloud` with normals and curvature: its own where it has both, all finite, and `radius` is
/// unset; else those of the neighbourhoods of that radius (chosen point by point without one).
Cloud with_surface(const Cloud& cloud, std::optional<double> radius, Context& context);

/// How far each point is from what stands opposite to it on the reference.
struct Deviations {
  Eigen::VectorXf distance;   ///< [m]
  Eigen::VectorXf normal;     ///< angle between the normals, their sign apart [rad]
  Eigen::VectorXf curvature;  ///< difference of λ0/Σλ, without sign

  explicit Deviations(Index count) : distance(count), normal(count), curvature(count) {}
};

/// The angle between two unit directions, their sign apart [rad]; accurate for small ones.
double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// `cloud` with the columns `distance`, `normal_deviation` and `curvature_difference`.
Cloud with_columns(const Cloud& cloud, const Deviations& found);

/// Records the figures of all three (`rms`, ...; `normal_rms`, ...; `curvature_rms`, ...) and gives
/// their histograms.
Table report_all(const Deviations& found, int bins, double limit, Context& context);

}  // namespace velum::deviation
