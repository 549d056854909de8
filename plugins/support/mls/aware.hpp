// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "mls/fit.hpp"

namespace velum::mls {

/// The widest neighbourhood that fit_aware looks at where a point is one-sided, of the radius.
inline constexpr double kWidest = 2.8284;

/// Does the neighbourhood of the radius lie on one side of `surface`'s point?
bool one_sided(const LocalSurface& surface, const FitOptions& options);

/// The surface at one point from several neighbourhoods: of half the radius up to `widest` times
/// the radius. Starting with the smallest, a wider one is taken into account while its height (its
/// normal) agrees with those of all smaller ones within the noise; of these the surest counts
/// (intersection of confidence intervals). So a border point, whose neighbours lie on one side, has
/// the area that it lacks made up for inside, and a place that bends within the radius is not
/// flattened. `found` are the neighbours within `widest` times the radius, ascending; `noise` is
/// the range noise [m].
std::optional<LocalSurface> fit_aware(const Support& support, const Eigen::Vector3f& point,
                                      std::span<const Neighbour> found, const FitOptions& options,
                                      double widest, double noise);

/// The step onto `surface` that is most likely right when noise moved the point along its ray:
/// to where the ray meets the surface, the sideways part weighted by how well the meeting is known.
/// `to_sensor` is the way from the point to where it was seen from.
Eigen::Vector3d step_along_ray(const LocalSurface& surface, const Eigen::Vector3d& to_sensor,
                               double noise);

}  // namespace velum::mls
