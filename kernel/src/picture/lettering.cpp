// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "picture/lettering.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace velum::picture {
namespace {

using Eigen::Vector2d;

/// A letter's strokes in units of a twelfth of the height of capitals, the base line at 0.
struct Glyph {
  std::vector<std::vector<Vector2d>> strokes;
  double width = 0.0;
};

constexpr double kCapital = 12.0;
constexpr double kGap = 3.2;  // between letters
constexpr double kBlank = 7.0;

/// Strokes by character. Each begins with its kind: l, straight from point to point; o, a curve
/// through them; c, a closed curve. A point is two digits to the base 36, x and y + 4.
const std::map<char32_t, std::string>& drawings() {
  static const std::map<char32_t, std::string> kDrawings = {
      {U'0', "c4g1e0a1644768a7e"},
      {U'1', "l2d5g54"},
      {U'2', "o0d1f4g7f8d7a04 l0484"},
      {U'3', "o0e2g6g8d6a3a o3a6a87642406"},
      {U'4', "l6g0888 l6g64"},
      {U'5', "l7g1g0a o0a3b6b88642406"},
      {U'6', "c082b6b886424 o7g3e08"},
      {U'7', "l0g8g34"},
      {U'8', "c4g1f1b4a7b7f c4a19071544758779"},
      {U'9', "c8c69290c2g6g o8c6624"},
      {U'A', "l045ga4 l2888"},
      {U'B', "l040g4g o4g7f7b4a l0a4a o4a898544 l4404"},
      {U'C', "o9e7g3g0c08347496"},
      {U'D', "l040g4g o4g8d8744 l4404"},
      {U'E', "l8g0g0484 l0a6a"},
      {U'F', "l8g0g04 l0a6a"},
      {U'G', "o9e7g3g0c08347496 l969a5a"},
      {U'H', "l040g l848g l0a8a"},
      {U'I', "l242g l0444 l0g4g"},
      {U'J', "l6g67 o67541406"},
      {U'K', "l040g l8g08 l2a84"},
      {U'L', "l0g0484"},
      {U'M', "l040g58aga4"},
      {U'N', "l040g848g"},
      {U'O', "c5g1e0a165496aa9e"},
      {U'P', "l040g5g o5g8f8a59 l5909"},
      {U'Q', "c5g1e0a165496aa9e l67a3"},
      {U'R', "l040g5g o5g8f8a59 l5909 l4984"},
      {U'S', "o8e6g2g0d2b6987642406"},
      {U'T', "l0g8g l4g44"},
      {U'U', "l0g08 o0815447588 l888g"},
      {U'V', "l0g448g"},
      {U'W', "l0g346d94cg"},
      {U'X', "l048g l0g84"},
      {U'Y', "l0g4a8g l4a44"},
      {U'Z', "l0g8g0484"},
      {U'a', "c4c1b08154465786b l7c74"},
      {U'b', "l040g c3c1b08153465786b"},
      {U'c', "o7b4c1b08154475"},
      {U'd', "c4c1b08154465786b l7g74"},
      {U'e', "l0878 o786b4c1b08154475"},
      {U'f', "o5g3g2d l2d24 l0c5c"},
      {U'g', "c4c1b08154465786b l7c73 o73613001"},
      {U'h', "l040g o092c5c79 l7974"},
      {U'i', "l0c04 l0g0g"},
      {U'j', "l2c22 o221000 l2g2g"},
      {U'k', "l040g l6c07 l2964"},
      {U'l', "l0g04"},
      {U'm', "l0c04 o092c4c59 l5954 o597c9ca9 la9a4"},
      {U'n', "l0c04 o092c5c79 l7974"},
      {U'o', "c4c1b08154475887b"},
      {U'p', "l0c00 c3c1b08153465786b"},
      {U'q', "c4c1b08154465786b l7c70"},
      {U'r', "l0c04 o092c5c"},
      {U's', "o6b3c0a38663405"},
      {U't', "l2g26 o263454 l0c5c"},
      {U'u', "l0c07 o07245477 l7c74"},
      {U'v', "l0c346c"},
      {U'w', "l0c245b84ac"},
      {U'x', "l046c l0c64"},
      {U'y', "l0c34 l6c20"},
      {U'z', "l0c6c0464"},
      {U'.', "l0404"},
      {U',', "l1502"},
      {U':', "l0a0a l0505"},
      {U'-', "l0949"},
      {U'_', "l0373"},
      {U'+', "l0868 l3b35"},
      {U'=', "l0a6a l0767"},
      {U'/', "l035g"},
      {U'(', "o3g1c1733"},
      {U')', "o0g2c2703"},
      {U'[', "l3g0g0333"},
      {U']', "l0g3g3303"},
      {U'%', "l048g c2g0e2c4e c68466486"},
      {U'\u00b0', "c2g0e2c4e"},
      {U'\u00b2', "o0f2g4e0a l0a4a"},
  };
  return kDrawings;
}

int digit(char c) {
  return c <= '9' ? c - '0' : c - 'a' + 10;
}

/// A curve through the points (Catmull and Rom, 1974).
std::vector<Vector2d> curve(const std::vector<Vector2d>& points, bool closed) {
  constexpr int kParts = 6;
  const auto count = static_cast<int>(points.size());
  const auto at = [&](int i) {
    const int k = closed ? (i + count) % count : std::clamp(i, 0, count - 1);
    return points[static_cast<std::size_t>(k)];
  };
  std::vector<Vector2d> fine;
  for (int i = 0; i < (closed ? count : count - 1); ++i)
    for (int part = 0; part < kParts; ++part) {
      const double t = static_cast<double>(part) / kParts;
      fine.emplace_back(0.5 *
                        (2.0 * at(i) + t * (at(i + 1) - at(i - 1)) +
                         t * t * (2.0 * at(i - 1) - 5.0 * at(i) + 4.0 * at(i + 1) - at(i + 2)) +
                         t * t * t * (3.0 * at(i) - at(i - 1) - 3.0 * at(i + 1) + at(i + 2))));
    }
  fine.push_back(at(closed ? 0 : count - 1));
  return fine;
}

Glyph parse(std::string_view drawing) {
  constexpr double kBase = 4.0;
  Glyph glyph;
  while (!drawing.empty()) {
    const std::string_view stroke = drawing.substr(0, drawing.find(' '));
    drawing.remove_prefix(std::min(drawing.size(), stroke.size() + 1));
    std::vector<Vector2d> points;
    for (std::size_t i = 1; i + 1 < stroke.size(); i += 2)
      points.emplace_back(digit(stroke[i]), digit(stroke[i + 1]) - kBase);
    for (const Vector2d& p : points) glyph.width = std::max(glyph.width, p.x());
    const char kind = stroke.front();
    glyph.strokes.push_back(kind == 'l' ? points : curve(points, kind == 'c'));
  }
  return glyph;
}

/// A frame for what has no drawing.
const Glyph& glyph_of(char32_t letter) {
  static const auto kGlyphs = [] {
    std::map<char32_t, Glyph> glyphs;
    for (const auto& [c, drawing] : drawings()) glyphs.emplace(c, parse(drawing));
    return glyphs;
  }();
  static const Glyph kUnknown = parse("l040g6g6404");
  const auto found = kGlyphs.find(letter);
  return found == kGlyphs.end() ? kUnknown : found->second;
}

/// The characters of UTF-8 text; bytes that are none stand for themselves.
std::u32string letters_of(std::string_view text) {
  std::u32string letters;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t length = first < 0xC0U ? 1 : first < 0xE0U ? 2 : first < 0xF0U ? 3 : 4;
    char32_t letter = length == 1 ? first : first & (0x7FU >> length);
    for (std::size_t k = 1; k < length && i + k < text.size(); ++k)
      letter = letter << 6U | (static_cast<unsigned char>(text[i + k]) & 0x3FU);
    letters += letter;
    i += length;
  }
  return letters;
}

}  // namespace

void draw_line(Image& image, const Vector2d& from, const Vector2d& to, double width,
               const Colour& colour) {
  const double radius = 0.5 * width;
  const Vector2d low = from.cwiseMin(to).array() - radius - 1.0;
  const Vector2d high = from.cwiseMax(to).array() + radius + 1.0;
  const Vector2d along = to - from;
  const double square = along.squaredNorm();
  for (int y = static_cast<int>(std::floor(low.y())); y <= high.y(); ++y)
    for (int x = static_cast<int>(std::floor(low.x())); x <= high.x(); ++x) {
      const Vector2d p = Vector2d(x + 0.5, y + 0.5) - from;
      const double s = square > 0.0 ? std::clamp(p.dot(along) / square, 0.0, 1.0) : 0.0;
      const double cover = std::clamp(radius + 0.5 - (p - s * along).norm(), 0.0, 1.0);
      if (cover > 0.0) image.blend(x, y, colour, static_cast<float>(cover));
    }
}

void fill(Image& image, int left, int top, int width, int height, const Colour& colour) {
  for (int y = top; y < top + height; ++y)
    for (int x = left; x < left + width; ++x) image.blend(x, y, colour, 1.0F);
}

void draw_text(Image& image, std::string_view text, double left, double base, double size,
               const Colour& colour) {
  const double scale = size / kCapital;
  const double width = std::max(1.1, 0.115 * size);
  for (const char32_t letter : letters_of(text)) {
    if (letter == U' ') {
      left += kBlank * scale;
      continue;
    }
    const Glyph& glyph = glyph_of(letter);
    const auto place = [&](const Vector2d& p) {
      return Vector2d(left + p.x() * scale, base - p.y() * scale);
    };
    for (const auto& stroke : glyph.strokes)
      for (std::size_t i = 0; i + 1 < stroke.size(); ++i)
        draw_line(image, place(stroke[i]), place(stroke[i + 1]), width, colour);
    left += (glyph.width + kGap) * scale;
  }
}

double width_of(std::string_view text, double size) {
  double width = 0.0;
  for (const char32_t letter : letters_of(text))
    width += letter == U' ' ? kBlank : glyph_of(letter).width + kGap;
  return width * size / kCapital;
}

}  // namespace velum::picture
