// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "shapes/shape.hpp"

namespace velum::shapes {

/// Three points with their normals.
struct Sample {
  std::array<Eigen::Vector3d, 3> points;
  std::array<Eigen::Vector3d, 3> normals;
};

/// The shape of this kind that goes through the sample (Schnabel et al. 2007, section 4.1): nothing
/// when the sample does not fix one. Which side normals point to does not matter.
std::optional<Shape> through(Kind kind, const Sample& sample);

/// The shape near `start` with the least mean square distance from these points: principal
/// components for a plane, Levenberg and Marquardt on the true distances for the others. Gives
/// `start` back when the points do not fix it.
Shape refine(const Shape& start, const Points& positions, std::span<const std::int32_t> members,
             Context& context);

/// Root mean square distance of the points from the shape [m].
double rms(const Shape& shape, const Points& positions, std::span<const std::int32_t> members,
           Context& context);

}  // namespace velum::shapes
