// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <velum/cloud.hpp>
#include <velum/context.hpp>

namespace velum::geometry {

/// Which neighbours make a point's normal. With neither `neighbours` nor `radius` the neighbourhood
/// is chosen point by point: it grows until the normal's expected error under the range noise falls
/// to `accuracy`, or until the fit's residual shows that the surface bends within it.
struct NormalOptions {
  std::optional<Index> neighbours;  ///< k nearest, the point itself among them
  std::optional<double> radius;     ///< [m]; with `neighbours`: at most that many within it
  std::optional<double> noise;      ///< [m]; unset: estimated from the cloud
  double accuracy = 0.026;          ///< [rad], error of a normal (root mean square) aimed at
};

struct NormalField {
  Points normals;             ///< unit, towards the sensor
  Eigen::VectorXf curvature;  ///< λ0/Σλ (thesis 3.2), at most 1/3
  Index degenerate = 0;       ///< points whose neighbours fix no plane
  double neighbours = 0.0;    ///< mean size of the neighbourhoods
  double noise = 0.0;         ///< [m], as given or estimated; 0 where the choice was not automatic
};

/// Normals by principal components of the neighbourhood (thesis 3.1.3) and surface variation
/// (3.1.4). Each normal points to the half space of the sensor that saw the point; in a cloud
/// without sensors, of the origin of the axes, as in the thesis. Where the neighbours fix no plane
/// (fewer than three distinct points, or on one line) the normal is the direction to the sensor,
/// turned square to the line, and curvature is 0.
NormalField estimate_normals(const Cloud& cloud, const NormalOptions& options, Context& context);

/// Range noise [m], one standard deviation: the median residual of local second-order fits at up to
/// 512 evenly chosen points, each over the smallest ball that is well wider than its own residual.
/// 0 where no point has enough neighbours for a fit.
double estimate_noise(const Cloud& cloud, Context& context);

}  // namespace velum::geometry
