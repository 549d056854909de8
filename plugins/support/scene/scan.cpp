// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "scene/scan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scene/caster.hpp"

namespace velum::scene {
namespace {

using Eigen::Vector3d;

constexpr std::int32_t kMixed = -1;
// The laser's spot (LMS 511, high resolution): diameter at the window [m], and growth a metre.
constexpr double kWindowSpot = 0.013;
constexpr double kDivergence = 0.0046;

double spot_diameter(double range) {
  return kWindowSpot + kDivergence * range;
}

struct Beam {
  double angle;
  double tilt;
  [[nodiscard]] Vector3d direction() const {
    return {std::cos(angle), std::sin(angle) * std::cos(tilt), std::sin(angle) * std::sin(tilt)};
  }
};

struct Return {
  float x, y, z;
  float tilt;
  std::int32_t label;
  std::int32_t beam;
};

Index steps(double from, double to, double step) {
  return static_cast<Index>(std::floor((to - from) / step + 1e-9)) + 1;
}

// One scanner in its scene.
class View {
 public:
  View(const Scene& scene, const Scanner& scanner)
      : scene_(scene), scanner_(scanner), caster_(scene) {}

  // `aside` is off the middle of the beam, in radii of the spot.
  [[nodiscard]] std::optional<Caster::Hit> cast(const Vector3d& direction,
                                                const Vector3d& aside = Vector3d::Zero()) const {
    const Vector3d from = 0.5 * kWindowSpot * aside;
    const Vector3d along = (direction + 0.5 * kDivergence * aside).normalized();
    return caster_.cast({scanner_.pose * from, scanner_.pose.linear() * along},
                        {scanner_.range_min, scanner_.range_max});
  }
  [[nodiscard]] std::int32_t label(const Caster::Hit& hit) const {
    return scene_.objects[static_cast<std::size_t>(hit.object)].label;
  }

  // Range and label of a beam with an infinitely thin ray.
  struct Echo {
    double range;
    std::int32_t label;
  };
  [[nodiscard]] std::optional<Echo> thin(const Vector3d& direction) const {
    const auto hit = cast(direction);
    if (!hit) return std::nullopt;
    return Echo{hit->range, label(*hit)};
  }

  // A beam with its spot, sampled by the ray in the middle and two rings of eight of equal share.
  // What lies within three spots behind the nearest hit is one surface (seen at up to 70 degrees);
  // what lies farther back is another, and the range is the mean over the spot. A spot that falls
  // half or more on nothing gives no return: too little light comes back.
  [[nodiscard]] std::optional<Echo> wide(const Vector3d& direction) const {
    const auto middle = cast(direction);
    const Vector3d side = direction.unitOrthogonal();
    const Vector3d other = direction.cross(side);
    constexpr int kRays = 17;
    std::array<double, kRays> ranges{};
    std::size_t hits = 0;
    if (middle) ranges[hits++] = middle->range;
    for (int i = 0; i < kRays - 1; ++i) {
      const double turn = std::numbers::pi / 4.0 * (i + (i >= 8 ? 0.5 : 0.0));
      const double radius = i < 8 ? 0.5 : 0.87;
      const auto hit = cast(direction, radius * (std::cos(turn) * side + std::sin(turn) * other));
      if (hit) ranges[hits++] = hit->range;
    }
    if (2 * hits <= kRays) return std::nullopt;
    const auto end = ranges.begin() + static_cast<std::ptrdiff_t>(hits);
    const double nearest = *std::min_element(ranges.begin(), end);
    const double farthest = *std::max_element(ranges.begin(), end);
    if (farthest - nearest <= 3.0 * spot_diameter(nearest)) {
      if (!middle) return std::nullopt;
      return Echo{middle->range, label(*middle)};
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < hits; ++i) sum += ranges[i];
    return Echo{sum / static_cast<double>(hits), kMixed};
  }

 private:
  const Scene& scene_;
  const Scanner& scanner_;
  Caster caster_;
};

Cloud gather(const std::vector<std::vector<Return>>& lines, const Scanner& scanner) {
  std::size_t count = 0;
  for (const auto& line : lines) count += line.size();
  const auto n = static_cast<Index>(count);
  Points positions(3, n);
  Eigen::VectorXi label(n);
  Eigen::VectorXi beam(n);
  Eigen::VectorXi number(n);
  Eigen::VectorXf tilt(n);
  Index at = 0;
  for (std::size_t line = 0; line < lines.size(); ++line)
    for (const Return& one : lines[line]) {
      positions.col(at) << one.x, one.y, one.z;
      label[at] = one.label;
      beam[at] = one.beam;
      number[at] = static_cast<std::int32_t>(line);
      tilt[at++] = one.tilt;
    }
  return Cloud(std::move(positions))
      .with(column::kLabel, Column(std::move(label)))
      .with(column::kBeam, Column(std::move(beam)))
      .with(column::kLine, Column(std::move(number)))
      .with(column::kTilt, Column(std::move(tilt)))
      .with(column::kSensor, Column(VectorXu8(VectorXu8::Zero(n))))
      .with_sensors({{scanner.name, Pose::Identity()}});
}

}  // namespace

Cloud scan(const Scene& scene, const Scanner& scanner, bool mixed_pixels, const Random& random,
           Context& context) {
  const View view(scene, scanner);
  const Index lines = steps(scanner.tilt_from, scanner.tilt_to, scanner.tilt_step);
  const Index beams = steps(scanner.beam_from, scanner.beam_to, scanner.beam_step);
  std::vector<std::vector<Return>> returns(static_cast<std::size_t>(lines));
  parallel_for(context, lines, 1, [&](Index line, Index) {
    context.check();
    auto& own = returns[static_cast<std::size_t>(line)];
    own.reserve(static_cast<std::size_t>(beams));
    const double tilt = scanner.tilt_from + static_cast<double>(line) * scanner.tilt_step;
    for (Index i = 0; i < beams; ++i) {
      const Beam beam{scanner.beam_from + static_cast<double>(i) * scanner.beam_step, tilt};
      const Vector3d direction = beam.direction();
      const auto echo = mixed_pixels ? view.wide(direction) : view.thin(direction);
      if (!echo) continue;
      Random stream = random.split(static_cast<std::uint64_t>(line * beams + i));
      const double range = echo->range + scanner.noise * stream.gaussian();
      const Eigen::Vector3f at = (range * direction).cast<float>();
      own.push_back({at.x(), at.y(), at.z(), static_cast<float>(tilt), echo->label,
                     static_cast<std::int32_t>(i)});
    }
  });
  return gather(returns, scanner);
}

}  // namespace velum::scene
