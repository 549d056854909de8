// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>
#include <velum/context.hpp>

#include "shapes/ransac.hpp"

namespace velum::shapes {

/// The points that take part, in single precision about their middle, and what agrees with a shape.
struct Field {
  explicit Field(const Cloud& cloud);
  Points positions;
  Points normals;
  Eigen::Vector3f middle;  ///< what was taken from the positions

  [[nodiscard]] static bool agrees(const Residual& residual, float epsilon, float cosine) {
    return residual.distance <= epsilon && residual.cosine >= cosine;
  }
  /// Those of `points` that lie within `epsilon` of the shape with normals within `angle`, in
  /// their order.
  [[nodiscard]] std::vector<std::int32_t> consensus(const Shape& shape,
                                                    const std::vector<std::int32_t>& points,
                                                    double epsilon, double angle,
                                                    Context& context) const;
};

/// The shape refitted to what agrees with it until it gains no more; `members` are those in the
/// end.
Shape polished(const Field& field, Shape shape, const std::vector<std::int32_t>& points,
               const Search& search, std::vector<std::int32_t>& members, Context& context);

/// A plane is also a part of a huge ball: the simplest of the kinds sought that explains nearly all
/// `members` of a shape, or the shape itself. `members` become those of the result.
Shape simplest(const Field& field, const Shape& shape, const std::vector<std::int32_t>& points,
               const Search& search, std::vector<std::int32_t>& members, Context& context);

/// Could this be one of the shapes sought? Not a ball as large as the scene, nor a flat cone.
bool admissible(const Shape& shape, const Search& search);

}  // namespace velum::shapes
