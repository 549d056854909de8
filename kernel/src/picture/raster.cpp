// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "picture/raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace velum::picture {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr int kScale = 2;
constexpr float kNothing = std::numeric_limits<float>::lowest();
constexpr float kLargest = 4.2F;  // radius of a point in the buffer
constexpr float kSmallest = 1.0F;
constexpr int kReach = 3;  // of eye-dome lighting in the buffer
/// How far behind its neighbour a place is fully dark [buffer pixels].
constexpr float kDeep = 40.0F;
constexpr float kDarkest = 0.55F;

/// Unit normals of vertices: those of their triangles by area.
std::vector<Vector3f> normals_of(const ConstPoints& positions, const ConstTriangles& triangles) {
  std::vector<Vector3f> normals(static_cast<std::size_t>(positions.cols()), Vector3f::Zero());
  for (Index t = 0; t < triangles.cols(); ++t) {
    const Vector3f a = positions.col(triangles(0, t));
    const Vector3f b = positions.col(triangles(1, t));
    const Vector3f c = positions.col(triangles(2, t));
    const Vector3f normal = (b - a).cross(c - a);
    for (int k = 0; k < 3; ++k) normals[static_cast<std::size_t>(triangles(k, t))] += normal;
  }
  for (Vector3f& normal : normals) normal.normalize();
  return normals;
}

}  // namespace

Raster::Raster(int width, int height, const Camera& camera)
    : width_(kScale * width), height_(kScale * height), camera_(camera) {
  camera_.pixels *= kScale;
  const auto size = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  heights_.assign(size, kNothing);
  colours_.assign(size, Colour::Ones());
}

Vector3f Raster::project(const Vector3f& position) const {
  const Vector3f seen = camera_.axes * position;
  return {0.5F * static_cast<float>(width_) + camera_.pixels * (seen.x() - camera_.middle.x()),
          0.5F * static_cast<float>(height_) - camera_.pixels * (seen.y() - camera_.middle.y()),
          camera_.pixels * seen.z()};
}

void Raster::put(int x, int y, float height, const Colour& colour) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  const auto place =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  if (height <= heights_[place]) return;
  heights_[place] = height;
  colours_[place] = colour;
}

void Raster::draw_points(const ConstPoints& positions, const std::vector<Colour>& colours) {
  const auto area = static_cast<float>(width_) * static_cast<float>(height_);
  const auto count = static_cast<float>(std::max<Index>(positions.cols(), 1));
  const float radius = std::clamp(0.5F * std::sqrt(area / count), kSmallest, kLargest);
  const int reach = static_cast<int>(std::ceil(radius));
  for (Index i = 0; i < positions.cols(); ++i) {
    const Vector3f at = project(positions.col(i));
    if (!(std::abs(at.x()) < 1e6F) || !(std::abs(at.y()) < 1e6F)) continue;
    const int x = static_cast<int>(std::floor(at.x()));
    const int y = static_cast<int>(std::floor(at.y()));
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        const Vector2f off(static_cast<float>(x + dx) + 0.5F - at.x(),
                           static_cast<float>(y + dy) + 0.5F - at.y());
        if (off.squaredNorm() <= radius * radius)
          put(x + dx, y + dy, at.z(), colours[static_cast<std::size_t>(i)]);
      }
  }
}

void Raster::draw_triangles(const ConstPoints& positions, const ConstTriangles& triangles,
                            const std::vector<Colour>& colours) {
  const std::vector<Vector3f> normals = normals_of(positions, triangles);
  // Above the viewer's left shoulder.
  const Vector3f light = camera_.axes.transpose() * Vector3f(-0.35F, 0.45F, 0.85F).normalized();
  std::vector<Corner> corners(normals.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const bool turned = normals[i].dot(camera_.axes.row(2)) < 0.0F;
    const float lit = std::max(0.0F, (turned ? -1.0F : 1.0F) * normals[i].dot(light));
    corners[i] = {project(positions.col(static_cast<Index>(i))), colours[i] * (0.66F + 0.4F * lit)};
  }
  const auto corner = [&](Index t, int k) -> const Corner& {
    return corners[static_cast<std::size_t>(triangles(k, t))];
  };
  for (Index t = 0; t < triangles.cols(); ++t) fill(corner(t, 0), corner(t, 1), corner(t, 2));
}

void Raster::fill(const Corner& a, const Corner& b, const Corner& c) {
  const Vector2f low = a.at.head<2>().cwiseMin(b.at.head<2>()).cwiseMin(c.at.head<2>());
  const Vector2f high = a.at.head<2>().cwiseMax(b.at.head<2>()).cwiseMax(c.at.head<2>());
  const auto cross = [](const Vector2f& u, const Vector2f& v) {
    return u.x() * v.y() - u.y() * v.x();
  };
  const Vector2f ab = (b.at - a.at).head<2>();
  const Vector2f ac = (c.at - a.at).head<2>();
  const float area = cross(ab, ac);
  if (!(std::abs(area) > 1e-12F)) return;
  const auto limit = [](float x, int most) {
    return static_cast<int>(std::clamp(x, 0.0F, static_cast<float>(most)));
  };
  for (int y = limit(low.y(), height_ - 1); y <= limit(high.y(), height_ - 1); ++y)
    for (int x = limit(low.x(), width_ - 1); x <= limit(high.x(), width_ - 1); ++x) {
      const Vector2f p =
          Vector2f(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F) - a.at.head<2>();
      const float v = cross(p, ac) / area;
      const float w = cross(ab, p) / area;
      const float u = 1.0F - v - w;
      // A little beyond the edges, so that no gaps open between triangles.
      if (u < -1e-3F || v < -1e-3F || w < -1e-3F) continue;
      put(x, y, u * a.at.z() + v * b.at.z() + w * c.at.z(),
          u * a.colour + v * b.colour + w * c.colour);
    }
}

float Raster::shade(int x, int y) const {
  static constexpr std::array<std::array<int, 2>, 8> kAround = {
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};
  const auto height = [&](int column, int row) {
    return heights_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                    static_cast<std::size_t>(column)];
  };
  const float here = height(x, y);
  float hidden = 0.0F;
  for (const auto& [dx, dy] : kAround) {
    const int column = std::clamp(x + kReach * dx, 0, width_ - 1);
    const int row = std::clamp(y + kReach * dy, 0, height_ - 1);
    hidden += std::clamp((height(column, row) - here - kReach) / kDeep, 0.0F, 1.0F);
  }
  return 1.0F - kDarkest * hidden / static_cast<float>(kAround.size());
}

void Raster::show(Image& image, int left, int top) const {
  for (int y = 0; y < height_ / kScale; ++y)
    for (int x = 0; x < width_ / kScale; ++x) {
      Colour sum = Colour::Zero();
      float cover = 0.0F;
      for (int dy = 0; dy < kScale; ++dy)
        for (int dx = 0; dx < kScale; ++dx) {
          const int column = kScale * x + dx;
          const int row = kScale * y + dy;
          const auto place = static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                             static_cast<std::size_t>(column);
          if (heights_[place] == kNothing) continue;
          sum += colours_[place] * shade(column, row);
          cover += 1.0F;
        }
      if (cover > 0.0F)
        image.blend(left + x, top + y, sum / cover, cover / static_cast<float>(kScale * kScale));
    }
}

}  // namespace velum::picture
