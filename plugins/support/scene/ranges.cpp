// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "scene/ranges.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace velum::scene {
namespace {

using Eigen::Vector3d;

// The laser's spot (LMS 511, high resolution): diameter at the window [m], and growth a metre.
constexpr double kWindowSpot = 0.013;
constexpr double kDivergence = 0.0046;
// What lies that far behind a cloth is not the cloth itself [m].
constexpr double kBehind = 1e-3;

double spot_diameter(double range) {
  return kWindowSpot + kDivergence * range;
}

}  // namespace

Vector3d Beam::direction() const {
  return {std::cos(angle), std::sin(angle) * std::cos(tilt), std::sin(angle) * std::sin(tilt)};
}

RangeFinder::RangeFinder(const Scene& scene, const Scanner& scanner)
    : scene_(scene), scanner_(scanner), caster_(scene) {
  if (scene.sun && scanner.effects.has(Effect::light)) sunlight_ = find_sun();
}

// `aside` is off the middle of the beam, in radii of the spot.
Ray RangeFinder::ray(const Vector3d& direction, const Vector3d& aside) const {
  const Vector3d from = 0.5 * kWindowSpot * aside;
  const Vector3d along = (direction + 0.5 * kDivergence * aside).normalized();
  return {scanner_.pose * from, scanner_.pose.linear() * along};
}

RangeFinder::Target RangeFinder::target(const Ray& ray, const Caster::Hit& hit) const {
  const Object& object = scene_.objects[static_cast<std::size_t>(hit.object)];
  const bool oblique =
      scanner_.effects.has(Effect::incidence) || scanner_.effects.has(Effect::remission);
  return {hit.range, object.label, oblique ? caster_.incidence(ray, hit) : 0.0,
          object.material ? &*object.material : nullptr};
}

// A beam as an infinitely thin ray that sees nothing nearer than `near`.
std::optional<RangeFinder::Target> RangeFinder::thin(const Vector3d& direction, double near) const {
  const Ray along = ray(direction, Vector3d::Zero());
  const auto hit = caster_.cast(along, {near, scanner_.range_max});
  if (!hit) return std::nullopt;
  return target(along, *hit);
}

// A beam with its spot, sampled by the ray in the middle and two rings of eight of equal share.
// What lies within three spots behind the nearest hit is one surface (seen at up to 70 degrees);
// what lies farther back is another, and the range is the mean over the spot. A spot that falls
// half or more on nothing gives no return: too little light comes back.
std::optional<RangeFinder::Target> RangeFinder::wide(const Vector3d& direction) const {
  const auto middle = thin(direction, scanner_.range_min);
  const Vector3d side = direction.unitOrthogonal();
  const Vector3d other = direction.cross(side);
  constexpr int kRays = 17;
  std::array<double, kRays> ranges{};
  std::size_t hits = 0;
  if (middle) ranges[hits++] = middle->range;
  for (int i = 0; i < kRays - 1; ++i) {
    const double turn = std::numbers::pi / 4.0 * (i + (i >= 8 ? 0.5 : 0.0));
    const double radius = i < 8 ? 0.5 : 0.87;
    const Ray along = ray(direction, radius * (std::cos(turn) * side + std::sin(turn) * other));
    const auto hit = caster_.cast(along, {scanner_.range_min, scanner_.range_max});
    if (hit) ranges[hits++] = hit->range;
  }
  if (2 * hits <= kRays) return std::nullopt;
  const auto end = ranges.begin() + static_cast<std::ptrdiff_t>(hits);
  const double nearest = *std::min_element(ranges.begin(), end);
  const double farthest = *std::max_element(ranges.begin(), end);
  if (farthest - nearest <= 3.0 * spot_diameter(nearest)) return middle;
  double sum = 0.0;
  for (std::size_t i = 0; i < hits; ++i) sum += ranges[i];
  return Target{sum / static_cast<double>(hits), kMixedLabel, 0.0, nullptr};
}

// What the pulse comes back from: what it meets, or through cloth what is behind.
std::optional<RangeFinder::Target> RangeFinder::seen(const Vector3d& direction,
                                                     Random& stream) const {
  auto found = scanner_.effects.has(Effect::mixed_pixels) ? wide(direction)
                                                          : thin(direction, scanner_.range_min);
  if (!scanner_.effects.has(Effect::transparency)) return found;
  while (found && found->material != nullptr && stream.uniform() < found->material->transmission)
    found = thin(direction, found->range + kBehind);
  return found;
}

bool RangeFinder::lost(const Target& target, Random& stream) const {
  const double remission = target.material != nullptr ? target.material->remission : 1.0;
  if (scanner_.effects.has(Effect::remission) &&
      signal(target.range, target.incidence, remission) < kLeastSignal)
    return true;
  return scanner_.effects.has(Effect::incidence) &&
         stream.uniform() < incidence_loss(target.incidence);
}

double RangeFinder::spread(const Target& target, const Vector3d& direction) const {
  const bool own = scanner_.effects.has(Effect::material) && target.material != nullptr;
  double spread = own ? target.material->noise : scanner_.noise;
  if (sunlight_ != Sunlight::none) {
    const Vector3d sun = scanner_.pose.linear().transpose() * scene_.sun->direction;
    const double away = std::acos(std::clamp(sun.dot(direction), -1.0, 1.0));
    spread *= glare(sunlight_, away, scene_.sun->width);
  }
  if (!scanner_.effects.has(Effect::incidence)) return spread;
  return std::hypot(spread, incidence_spread(target.incidence, spot_diameter(target.range)));
}

double RangeFinder::bias(const Target& target, const Beam& beam) const {
  const Effects& effects = scanner_.effects;
  double bias = 0.0;
  if (effects.has(Effect::material) && target.material != nullptr) bias += target.material->offset;
  if (effects.has(Effect::distance)) bias += distance_error(target.range);
  if (effects.has(Effect::angulation)) bias += angulation_error(beam.angle);
  if (effects.has(Effect::warm_up)) bias += warm_up_error(beam.time / 3600.0);
  return bias;
}

std::optional<RangeFinder::Echo> RangeFinder::measure(const Beam& beam, Random stream) const {
  const double noise = stream.gaussian();
  const Vector3d direction = beam.direction();
  const auto found = seen(direction, stream);
  if (!found || lost(*found, stream)) return std::nullopt;
  const double remission = found->material != nullptr ? found->material->remission : 1.0;
  return Echo{found->range + bias(*found, beam) + spread(*found, direction) * noise, found->label,
              signal(found->range, found->incidence, remission)};
}

// The sun is direct where nothing stands before it, and shines through what lets pulses through.
Sunlight RangeFinder::find_sun() const {
  const Ray towards{scanner_.pose.translation(), scene_.sun->direction};
  Sunlight light = Sunlight::direct;
  Reach reach{scanner_.range_min};
  while (const auto hit = caster_.cast(towards, reach)) {
    const auto& material = scene_.objects[static_cast<std::size_t>(hit->object)].material;
    if (!material || material->transmission <= 0.0) return Sunlight::none;
    light = Sunlight::through_cloth;
    reach.near = hit->range + kBehind;
  }
  return light;
}

}  // namespace velum::scene
