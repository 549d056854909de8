// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "picture/camera.hpp"
#include "picture/image.hpp"

namespace velum::picture {

/// Points and triangles in a depth buffer, drawn twice as large as they are shown so that edges are
/// smooth.
class Raster {
 public:
  /// Pixels of the picture to be made.
  Raster(int width, int height, const Camera& camera);

  /// One colour a position; as large as it takes for the points to close up, where they are dense.
  void draw_points(const ConstPoints& positions, const std::vector<Colour>& colours);
  /// One colour a vertex, lit from the viewer's side; both sides of a triangle look alike.
  void draw_triangles(const ConstPoints& positions, const ConstTriangles& triangles,
                      const std::vector<Colour>& colours);

  /// Puts what was drawn into the image, with its upper left corner at (left, top). What lies
  /// behind something near is darker around its edge (eye-dome lighting: Boucheny, 2009).
  void show(Image& image, int left, int top) const;

 private:
  struct Corner {
    Eigen::Vector3f at;  ///< column, row, height towards the viewer
    Colour colour;
  };
  [[nodiscard]] Eigen::Vector3f project(const Eigen::Vector3f& position) const;
  void put(int x, int y, float height, const Colour& colour);
  void fill(const Corner& a, const Corner& b, const Corner& c);
  [[nodiscard]] float shade(int x, int y) const;

  int width_;  ///< of the buffers, as height_
  int height_;
  Camera camera_;
  std::vector<float> heights_;  ///< towards the viewer; lowest: nothing there
  std::vector<Colour> colours_;
};

}  // namespace velum::picture
