// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>
#include <velum/testing.hpp>

#include "registration/test_data.hpp"
#include "registration/test_room.hpp"

/// The pairs that registration.global must bring together from any start.
namespace velum::registration::test {

inline constexpr double kDegree = std::numbers::pi / 180.0;
inline const std::string kScene = VELUM_SOURCE_DIR "/graphs/scenes/wind_tunnel.toml";

/// A pair with what counts as right; `reach` is how far [m] the source is thrown.
struct Pair {
  Cloud source;
  Cloud target;  ///< with normals
  Pose truth = Pose::Identity();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< where the miss is measured
  double rotation = 0.5 * kDegree;
  double translation = 0.0;
  double reach = 1.0;
};

inline Pair pair_of(const KnownPair& known, double rotation, double translation, double reach) {
  Pair pair{known.source, velum::test::Stage("features.normals").run(known.target).cloud(),
            known.truth,  {},
            rotation,     translation,
            reach};
  pair.middle = pair.source.origin() + pair.source.positions().cast<double>().rowwise().mean();
  return pair;
}

inline std::optional<Pair> pair_of(const std::optional<KnownPair>& known, double rotation,
                                   double translation, double reach) {
  if (!known) return {};
  return pair_of(*known, rotation, translation, reach);
}

/// What of the scene below is taken.
using Part = std::function<bool(const Eigen::Vector3d&)>;

inline Part left_of(double x) {
  return [x](const Eigen::Vector3d& point) { return point.x() <= x; };
}
inline Part right_of(double x) {
  return [x](const Eigen::Vector3d& point) { return point.x() >= x; };
}

/// The thesis's four shapes (figure 3.13) over a floor of 60 m: as many points on each as in its
/// table 3.24.
inline Cloud shapes(std::uint64_t seed, const Part& part = {}) {
  Random random(seed);
  std::vector<Eigen::Vector3f> found;
  const auto put = [&](double x, double y, double z) {
    const Eigen::Vector3d point(x, y, z);
    if (!part || part(point)) found.push_back(point.cast<float>());
  };
  const auto turn = [&] { return random.uniform(0.0, 2.0 * std::numbers::pi); };
  for (int i = 0; i < 3600; ++i) {
    const double x = random.uniform(-10.0, 50.0);
    put(x, random.uniform(-10.0, 50.0), 0.0);
  }
  for (int i = 0; i < 8100; ++i) {
    const double z = random.uniform(-1.0, 1.0);
    const double a = turn();
    const double r = std::sqrt(1.0 - z * z);
    put(10.0 + 8.0 * r * std::cos(a), 8.0 + 8.0 * r * std::sin(a), 12.0 + 8.0 * z);
  }
  for (int i = 0; i < 3600; ++i) {
    const double a = turn();
    put(35.0 + 5.0 * std::cos(a), 12.0 + 5.0 * std::sin(a), random.uniform(2.0, 22.0));
  }
  for (int i = 0; i < 5611; ++i) {
    const double a = turn();
    const double h = std::sqrt(random.uniform());
    put(22.0 + 7.0 * h * std::cos(a), 36.0 + 7.0 * h * std::sin(a), 20.0 - 16.0 * h);
  }
  Points points(3, static_cast<Index>(found.size()));
  for (std::size_t i = 0; i < found.size(); ++i) points.col(static_cast<Index>(i)) = found[i];
  return Cloud(std::move(points));
}

/// Table 3.11: the scene against itself.
inline Pair whole() {
  return pair_of(KnownPair{shapes(1), shapes(1)}, 0.05 * kDegree, 0.01, 60.0);
}

/// Tables 3.17 and 3.21: a part of the scene against all of it.
inline Pair part() {
  return pair_of(KnownPair{shapes(1, left_of(23.0)), shapes(1)}, 0.05 * kDegree, 0.01, 200.0);
}

/// Two parts, each sampled by itself, on both sides of a diagonal: they share most of the pipe and
/// of the cone and the floor between, a third of the source's area and two thirds of the target's.
inline Pair corner() {
  const auto near = [](const Eigen::Vector3d& p) { return p.x() + p.y() <= 62.0; };
  const auto far = [](const Eigen::Vector3d& p) { return p.x() + p.y() >= 44.0; };
  return pair_of(KnownPair{shapes(2, near), shapes(1, far)}, 0.2 * kDegree, 0.05, 60.0);
}

/// The same with a strip from x = 8 to 21, half of the source's area. But for a piece of a cone it
/// turns about the ball's axis as it likes, and turned by 113 degrees more of the source lies on
/// the target than in truth.
inline Pair strip() {
  return pair_of(KnownPair{shapes(2, left_of(21.0)), shapes(1, right_of(8.0))}, 0.2 * kDegree, 0.05,
                 60.0);
}

inline Cloud tunnel_scan(const std::string& scanner, std::uint64_t seed) {
  return velum::test::Stage("devices.simulator")
      .set("scene", kScene)
      .set("scanner", scanner)
      .set("beam_step", "0.5")
      .set("tilt_step", "0.5")
      .seed(seed)
      .run()
      .cloud();
}

/// Both raw scans of the wind tunnel, which fits itself when turned by half a turn (thesis 3.2.2,
/// figure 3.17).
inline Pair tunnel() {
  KnownPair known{tunnel_scan("mainsail", 2), tunnel_scan("gennaker", 3)};
  known.truth = velum::test::Stage("devices.truth")
                    .set("scene", kScene)
                    .set("scanner", "mainsail")
                    .set("frame", "gennaker")
                    .run()
                    .get<Transform>()
                    .matrix;
  Pair pair = pair_of(known, 0.05 * kDegree, 2e-3, 5.0);
  pair.middle = {2.5, 0.0, 0.0};
  return pair;
}

inline std::optional<Pair> bunny_pair(const std::string& target, const std::string& source) {
  return pair_of(bunny(target, source), 0.5 * kDegree, 0.5e-3, 0.3);
}
inline std::optional<Pair> street_pair() {
  return pair_of(street(), 0.5 * kDegree, 0.1, 30.0);
}
inline std::optional<Pair> kitchen_pair() {
  return pair_of(kitchen(), 3.0 * kDegree, 0.15, 3.0);
}

}  // namespace velum::registration::test
