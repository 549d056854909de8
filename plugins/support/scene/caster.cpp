// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "scene/caster.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace velum::scene {
namespace {

constexpr double kSailError = 4e-5;  // [m]

}  // namespace

Caster::Caster(const Scene& scene) {
  std::int32_t number = 0;
  for (const Object& object : scene.objects) {
    for (const Shape& shape : object.shapes)
      std::visit(
          [&](const auto& own) {
            using S = std::remove_cvref_t<decltype(own)>;
            if constexpr (std::is_same_v<S, TriangleSet>) {
              tree_.add(own, number);
            } else if constexpr (std::is_same_v<S, Sail>) {
              Sail::Grid grid = own.grid_within(kSailError);
              tree_.add({std::move(grid.vertices), std::move(grid.triangles)}, number);
            } else {
              solids_.push_back(Placed<S>{own, number});
            }
          },
          shape);
    ++number;
  }
  tree_.build();
}

std::optional<Caster::Hit> Caster::cast(const Ray& ray, const Reach& reach) const {
  std::optional<Hit> best;
  Reach left = reach;
  for (std::size_t i = 0; i < solids_.size(); ++i)
    std::visit(
        [&](const auto& placed) {
          if (const auto range = meet(placed.shape, ray, left)) {
            best = {*range, placed.object, static_cast<std::int32_t>(i)};
            left.far = *range;
          }
        },
        solids_[i]);
  if (const auto hit = tree_.meet(ray, left)) best = {hit->range, hit->owner, ~hit->triangle};
  return best;
}

double Caster::incidence(const Ray& ray, const Hit& hit) const {
  const Eigen::Vector3d at = ray.from + hit.range * ray.along;
  const Eigen::Vector3d facing =
      hit.part < 0 ? tree_.normal(~hit.part)
                   : std::visit([&](const auto& placed) { return normal(placed.shape, at); },
                                solids_[static_cast<std::size_t>(hit.part)]);
  return std::acos(std::min(1.0, std::abs(facing.dot(ray.along))));
}

}  // namespace velum::scene
