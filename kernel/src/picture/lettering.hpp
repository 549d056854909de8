// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "picture/image.hpp"

namespace velum::picture {

/// A line with round ends, its edges smooth; in pixels from the upper left corner.
void draw_line(Image& image, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
               const Colour& colour);
void fill(Image& image, int left, int top, int width, int height, const Colour& colour);

/// Text in strokes, capitals `size` pixels high, from `left` on the base line `base`.
void draw_text(Image& image, std::string_view text, double left, double base, double size,
               const Colour& colour);
/// How long it is [pixels].
[[nodiscard]] double width_of(std::string_view text, double size);

}  // namespace velum::picture
