// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <vector>

/// Still pictures of clouds and meshes, drawn without a display or graphics hardware: the same
/// bytes every time.
namespace velum::picture {

/// Red, green and blue from 0 to 1, as they are shown (sRGB).
using Colour = Eigen::Array3f;

/// Rows from the top, white at first.
class Image {
 public:
  Image(int width, int height)
      : width_(width),
        height_(height),
        pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                Colour::Ones()) {}

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] Colour& at(int x, int y) { return pixels_[place(x, y)]; }
  [[nodiscard]] const Colour& at(int x, int y) const { return pixels_[place(x, y)]; }
  /// Lays a colour over a pixel, covering so much of it; nothing outside of the image.
  void blend(int x, int y, const Colour& colour, float cover) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    at(x, y) += cover * (colour - at(x, y));
  }

 private:
  [[nodiscard]] std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  int width_;
  int height_;
  std::vector<Colour> pixels_;
};

/// 8 bits a channel, atomically. Throws Error (Fault::output).
void write_png(const Image& image, const std::filesystem::path& file);

}  // namespace velum::picture
