// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "picture/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "picture/camera.hpp"
#include "picture/colours.hpp"
#include "picture/lettering.hpp"
#include "picture/raster.hpp"

namespace velum::picture {
namespace {

using Eigen::Vector2d;

// All in pixels.
constexpr int kWidth = 1400;
constexpr int kHeight = 1000;
constexpr int kBorder = 32;
constexpr int kTop = 96;     // for the titles
constexpr int kBottom = 92;  // for scale bar and axes
constexpr int kLegend = 190;
constexpr double kTitle = 20.0;
constexpr double kText = 14.0;

struct Range {
  double low = 0.0;
  double high = 1.0;
  /// Differences and ticks can be told in doubles.
  [[nodiscard]] bool wide() const {
    const double size = high - low;
    return std::isfinite(size) && size > 1e-12 * std::max(std::abs(low), std::abs(high));
  }
  [[nodiscard]] double share(double x) const { return wide() ? (x - low) / (high - low) : 0.5; }
};

/// Of the numbers without the outermost hundredth on each side.
Range range_of(const std::vector<double>& numbers) {
  std::vector<double> finite;
  for (const double x : numbers)
    if (std::isfinite(x)) finite.push_back(x);
  if (finite.empty()) return {};
  std::ranges::sort(finite);
  const std::size_t tail = finite.size() / 100;
  return {finite[tail], finite[finite.size() - 1 - tail]};
}

/// The largest of 1, 2 and 5 times a power of ten that is not above `most`.
double round_length(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= most) return digit * power;
  return power;
}

std::string length_in_words(double metres) {
  if (metres >= 1000.0) return fmt::format("{:g} km", metres / 1000.0);
  if (metres >= 1.0) return fmt::format("{:g} m", metres);
  if (metres >= 1e-3) return fmt::format("{:g} mm", std::round(metres * 1e6) / 1e3);
  return fmt::format("{:.3g} m", metres);
}

std::vector<Colour> colours_of(const Colouring& colouring, const Range& range, std::size_t count) {
  std::vector<Colour> colours(count, no_colour());
  for (std::size_t i = 0; i < std::min(count, colouring.numbers.size()); ++i) {
    const double x = colouring.numbers[i];
    if (!std::isfinite(x)) continue;
    colours[i] = colouring.labels ? colour_of_label(static_cast<std::int64_t>(x))
                                  : colour_of(range.share(x));
  }
  return colours;
}

void draw_bar(Image& image, const Colouring& colouring, const Range& range) {
  constexpr int kLeft = kWidth - kLegend + 20;
  constexpr int kBarWidth = 22;
  constexpr int kBarTop = kTop + 60;
  constexpr int kBarHeight = kHeight - kTop - kBottom - 160;
  const std::string unit = colouring.unit.empty() ? "" : " [" + colouring.unit + "]";
  draw_text(image, colouring.name + unit, kLeft, kBarTop - 24, kText, ink());
  if (!range.wide()) {
    fill(image, kLeft, kBarTop, kBarWidth, kBarWidth, colour_of(0.5));
    draw_text(image, fmt::format("{:.4g}", range.low), kLeft + kBarWidth + 12, kBarTop + 17, kText,
              ink());
    return;
  }
  for (int y = 0; y < kBarHeight; ++y)
    fill(image, kLeft, kBarTop + y, kBarWidth, 1, colour_of(1.0 - (y + 0.5) / kBarHeight));
  const double step = round_length((range.high - range.low) / 4.0);
  // Down to the digits of the step, so that ticks read 0.2 and not 0.2000001.
  const int digits = std::max(0, -static_cast<int>(std::floor(std::log10(step))));
  constexpr int kMostTicks = 21;
  for (int tick = 0; tick < kMostTicks; ++tick) {
    const double k = std::ceil(range.low / step) + tick;
    if (k * step > range.high) break;
    const double y = kBarTop + kBarHeight * (1.0 - range.share(k * step));
    draw_line(image, {kLeft + kBarWidth, y}, {kLeft + kBarWidth + 6.0, y}, 1.4, ink());
    const double number = k == 0.0 ? 0.0 : k * step;
    const std::string text =
        digits > 6 ? fmt::format("{:.3g}", number) : fmt::format("{:.{}f}", number, digits);
    draw_text(image, text, kLeft + kBarWidth + 12.0, y + 0.5 * kText, kText, ink());
  }
}

void draw_labels(Image& image, const Colouring& colouring) {
  constexpr int kLeft = kWidth - kLegend + 20;
  constexpr int kRow = 28;
  constexpr std::size_t kMost = 20;
  std::set<std::int64_t> found;
  for (const double x : colouring.numbers)
    if (std::isfinite(x)) found.insert(static_cast<std::int64_t>(std::max(x, -1.0)));
  int top = kTop + 60;
  draw_text(image, colouring.name, kLeft, top - 24, kText, ink());
  std::size_t told = 0;
  for (const std::int64_t label : found) {
    if (label < 0) continue;
    if (told++ == kMost) {
      draw_text(image, fmt::format("and {} more", found.size() - kMost), kLeft, top + 16, kText,
                ink());
      break;
    }
    fill(image, kLeft, top, 18, 18, colour_of_label(label));
    draw_text(image, std::to_string(label), kLeft + 30, top + 16, kText, ink());
    top += kRow;
  }
  if (!found.contains(-1) || told > kMost) return;
  fill(image, kLeft, top, 18, 18, no_colour());
  draw_text(image, "none", kLeft + 30, top + 16, kText, ink());
}

void draw_scale(Image& image, const Camera& camera, int width) {
  const double length = round_length(0.28 * width / static_cast<double>(camera.pixels));
  const double pixels = length * static_cast<double>(camera.pixels);
  const double left = kBorder + 110.0;
  const double y = kHeight - 36.0;
  draw_line(image, {left, y}, {left + pixels, y}, 2.4, ink());
  for (const double x : {left, left + pixels})
    draw_line(image, {x, y - 6.0}, {x, y + 6.0}, 2.4, ink());
  const std::string text = length_in_words(length);
  draw_text(image, text, left + 0.5 * (pixels - width_of(text, kText)), y - 14.0, kText, ink());
}

/// The directions of x, y and z in the picture.
void draw_axes(Image& image, const Camera& camera) {
  static const std::array<Colour, 3> kColours = {
      Colour(0.78F, 0.22F, 0.2F), Colour(0.2F, 0.55F, 0.25F), Colour(0.2F, 0.35F, 0.75F)};
  constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
  constexpr double kLength = 34.0;
  const Vector2d middle(kBorder + 36.0, kHeight - 44.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d seen = camera.axes.col(static_cast<Index>(axis)).cast<double>();
    const Vector2d tip = middle + kLength * Vector2d(seen.x(), -seen.y());
    draw_line(image, middle, tip, 2.2, kColours[axis]);
    const Vector2d beyond = (tip - middle) * 1.0 / kLength;
    if (beyond.norm() < 0.25) continue;  // it points at the viewer
    const Vector2d letter = tip + 11.0 * beyond.normalized();
    draw_text(image, kNames[axis], letter.x() - 4.0, letter.y() + 5.0, 11.0, kColours[axis]);
  }
}

}  // namespace

Image draw(const Shape& shape) {
  Image image(kWidth, kHeight);
  const int width = kWidth - kLegend - kBorder;
  const int height = kHeight - kTop - kBottom;
  const Camera camera = look_at(shape.positions, shape.eyes, width, height);
  const Range range = shape.colouring.labels ? Range{} : range_of(shape.colouring.numbers);
  const std::vector<Colour> colours =
      colours_of(shape.colouring, range, static_cast<std::size_t>(shape.positions.cols()));
  Raster raster(width, height, camera);
  if (shape.triangles)
    raster.draw_triangles(shape.positions, *shape.triangles, colours);
  else
    raster.draw_points(shape.positions, colours);
  raster.show(image, kBorder, kTop);

  draw_text(image, shape.title, kBorder, kBorder + 22.0, kTitle, ink());
  draw_text(image, shape.subtitle, kBorder, kBorder + 50.0, kText, Colour(0.36F, 0.37F, 0.4F));
  if (shape.colouring.labels)
    draw_labels(image, shape.colouring);
  else
    draw_bar(image, shape.colouring, range);
  draw_scale(image, camera, width);
  draw_axes(image, camera);
  return image;
}

}  // namespace velum::picture
