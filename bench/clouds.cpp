// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "clouds.hpp"

#include <cmath>
#include <numbers>
#include <velum/random.hpp>

namespace bench {
namespace {

constexpr double kLuff = 7.0;
constexpr double kFoot = 3.0;
constexpr double kCamber = 0.10;
constexpr double kTwist = 15.0 * std::numbers::pi / 180.0;
constexpr double kNoise = 0.004;
const Eigen::Vector3d kSensor(1.5, 6.0, 1.5);

Eigen::Vector3d on_sail(double u, double v) {
  const double chord = kFoot * (1.0 - 0.9 * v);
  const double along = u * chord;
  const double depth = 4.0 * kCamber * chord * u * (1.0 - u);
  const double angle = kTwist * v;
  return {along * std::cos(angle) - depth * std::sin(angle),
          along * std::sin(angle) + depth * std::cos(angle), kLuff * v};
}

velum::Points sample(velum::Index count, std::uint64_t seed) {
  velum::Points points(3, count);
  velum::Random random(seed);
  for (velum::Index i = 0; i < count; ++i) {
    // Accept by chord length so that the density is even.
    double v = random.uniform();
    while (random.uniform() > 1.0 - 0.9 * v) v = random.uniform();
    const Eigen::Vector3d p = on_sail(random.uniform(), v);
    const Eigen::Vector3d ray = (p - kSensor).normalized();
    points.col(i) = (p + kNoise * random.gaussian() * ray).cast<float>();
  }
  return points;
}

velum::Cloud with_sensor(velum::Points points) {
  velum::Pose pose = velum::Pose::Identity();
  pose.translation() = kSensor;
  return velum::Cloud(std::move(points)).with_sensors({{"bench", pose}});
}

}  // namespace

velum::Cloud sail(velum::Index count) {
  return with_sensor(sample(count, 1));
}

velum::Cloud sail_moved(velum::Index count) {
  velum::Pose motion = velum::Pose::Identity();
  motion.rotate(Eigen::AngleAxisd(2.0 * std::numbers::pi / 180.0,
                                  Eigen::Vector3d(1.0, 2.0, 3.0).normalized()));
  motion.translation() = Eigen::Vector3d(0.02, -0.02, 0.01);
  return with_sensor(sample(count, 2)).transformed(motion);
}

velum::test::Stage scanner(const std::string& name, velum::Index count) {
  constexpr double kStepDegrees = 0.25;
  constexpr double kPoints = 152'961.0;  // at that step
  const double step =
      std::max(kStepDegrees * std::sqrt(kPoints / static_cast<double>(count)), 0.0975);
  const std::string degrees = std::to_string(step) + " deg";
  return velum::test::Stage("devices.simulator")
      .set("scene", VELUM_SOURCE_DIR "/graphs/scenes/wind_tunnel.toml")
      .set("scanner", name)
      .set("beam_step", degrees)
      .set("tilt_step", degrees);
}

}  // namespace bench
