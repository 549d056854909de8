// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>
#include <optional>

#include "scene/caster.hpp"
#include "velum/random.hpp"

namespace velum::scene {

inline constexpr std::int32_t kMixedLabel = -1;  ///< of a range between two surfaces

/// One beam of a scanner.
struct Beam {
  double angle = 0.0;  ///< [rad]
  double tilt = 0.0;   ///< [rad]
  double time = 0.0;   ///< since power-on [s]
  /// Along (cos φ, sin φ cos τ, sin φ sin τ) in the scanner's frame.
  [[nodiscard]] Eigen::Vector3d direction() const;
};

/// What a scanner in its scene measures with one beam, with the scanner's errors. Immutable, so any
/// number of threads may ask.
class RangeFinder {
 public:
  struct Echo {
    double range;        ///< [m]
    std::int32_t label;  ///< of the object that it comes from, or kMixedLabel
    double signal;       ///< light that comes back; 1 from a white surface at 1 m
  };
  /// Scene and scanner must outlive it.
  RangeFinder(const Scene& scene, const Scanner& scanner);
  /// Nothing where no light comes back. `stream` is the beam's own: of every beam the first number
  /// drawn is its noise, whatever effects act.
  [[nodiscard]] std::optional<Echo> measure(const Beam& beam, Random stream) const;
  [[nodiscard]] Sunlight sunlight() const { return sunlight_; }

 private:
  struct Target {
    double range;
    std::int32_t label;
    double incidence;
    const Material* material;
  };
  [[nodiscard]] Ray ray(const Eigen::Vector3d& direction, const Eigen::Vector3d& aside) const;
  [[nodiscard]] Target target(const Ray& ray, const Caster::Hit& hit) const;
  [[nodiscard]] std::optional<Target> thin(const Eigen::Vector3d& direction, double near) const;
  [[nodiscard]] std::optional<Target> wide(const Eigen::Vector3d& direction) const;
  [[nodiscard]] std::optional<Target> seen(const Eigen::Vector3d& direction, Random& stream) const;
  [[nodiscard]] bool lost(const Target& target, Random& stream) const;
  [[nodiscard]] double spread(const Target& target, const Eigen::Vector3d& direction) const;
  [[nodiscard]] double bias(const Target& target, const Beam& beam) const;
  [[nodiscard]] Sunlight find_sun() const;

  const Scene& scene_;
  const Scanner& scanner_;
  Caster caster_;
  Sunlight sunlight_ = Sunlight::none;
};

}  // namespace velum::scene
