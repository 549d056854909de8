// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <velum/neighbours.hpp>

namespace velum::mls {

/// What surfaces are fitted to: points, each standing for a number of measured ones.
struct Support {
  ConstPoints points;
  std::span<const std::int32_t> counts;  ///< empty: each stands for one
};

struct FitOptions {
  int order = 2;
  double radius = 0.0;    ///< [m], of the neighbourhood
  double gaussian = 0.0;  ///< [m], h of the weight exp(−d²/h²)
  bool lower = true;      ///< take a lower order where the neighbours lie on one side
};

/// The fitted surface at one point.
struct LocalSurface {
  Eigen::Vector3d step;    ///< [m], from the point onto the surface, along the local plane's normal
  Eigen::Vector3d normal;  ///< of the surface there, unit, of either sign
  double curvature;        ///< λ0/Σλ of the fitted surface, free of noise
  int order;               ///< that the neighbours allowed
  double variance;         ///< of the height, in units of the points' σ²
  double slope_variance;   ///< of the two slopes together [1/m²], in units of σ²
  double slope_leverage;   ///< the same times radius² and the sum of the weights
};

/// Projects `point` on the surface that its neighbours describe (thesis 3.38 to 3.40): a weighted
/// plane H, then a polynomial of the heights over H with weights about the point's foot on it.
///
/// The order is lowered where the neighbours do not carry it: too few, on a line, or on one side
/// only (at a border), where a higher order would follow the noise. Nothing where they fix no
/// plane.
std::optional<LocalSurface> fit_surface(const Support& support, const Eigen::Vector3f& point,
                                        std::span<const Neighbour> found,
                                        const FitOptions& options);

}  // namespace velum::mls
