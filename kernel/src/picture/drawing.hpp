// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "picture/image.hpp"
#include "velum/types.hpp"

namespace velum::picture {

/// By what a shape is coloured, and what the legend says of it.
struct Colouring {
  std::string name;  ///< "height"
  std::string unit;  ///< "m"; "" for none
  /// One a point; NaN where there is none.
  std::vector<double> numbers;
  /// The numbers are labels, not amounts: negative ones mean none.
  bool labels = false;
};

/// What is to be drawn. The arrays belong to the caller.
struct Shape {
  ConstPoints positions;
  std::optional<ConstTriangles> triangles = std::nullopt;  ///< nothing: points are drawn
  std::vector<Eigen::Vector3f> eyes = {};                  ///< where scanners stand
  Colouring colouring = {};
  std::string title = {};
  std::string subtitle = {};
};

/// A picture with title, legend, scale bar and the directions of the axes.
[[nodiscard]] Image draw(const Shape& shape);

}  // namespace velum::picture
