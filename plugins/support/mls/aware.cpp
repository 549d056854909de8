// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "mls/aware.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace velum::mls {
namespace {

using Found = std::span<const Neighbour>;

// Neighbourhoods, of the radius: each has about twice the area of the one before.
constexpr std::array<double, 6> kScales = {0.5, 0.7071, 1.0, 1.4142, 2.0, kWidest};
// Two neighbourhoods agree when they differ by less than this many variances of the less certain.
constexpr double kAgree = 4.0;
// Slope variance [σ²/radius² over the number of points] of a full disc is 8 for orders 1 and 2;
// above this bound the neighbours are taken to lie on one side.
constexpr double kOneSidedSlope = 12.0;
// Steps longer than this many standard deviations are no noise: nothing is known of their
// direction.
constexpr double kOutlier = 5.0;

// Neighbourhoods that agree so far, about one quantity, and the surest of them.
class Agreement {
 public:
  // `gap2` tells how far two candidates are apart (squared); false when the new one disagrees.
  template <class Gap>
  bool add(const std::vector<LocalSurface>& all, double (*variance)(const LocalSurface&),
           double noise, const Gap& gap2) {
    const LocalSurface& fresh = all.back();
    const double limit = kAgree * noise * noise;
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
      if (gap2(all[i], fresh) > limit * std::max(variance(all[i]), variance(fresh))) return false;
    if (all.size() == 1 || variance(fresh) < variance(all[best_])) best_ = all.size() - 1;
    return true;
  }
  [[nodiscard]] std::size_t best() const { return best_; }

 private:
  std::size_t best_ = 0;
};

double height_variance(const LocalSurface& surface) {
  return surface.variance;
}
double normal_variance(const LocalSurface& surface) {
  return surface.slope_variance;
}
double height_gap2(const LocalSurface& a, const LocalSurface& b) {
  const double gap = (a.step - b.step).dot(a.normal);
  return gap * gap;
}
double normal_gap2(const LocalSurface& a, const LocalSurface& b) {
  return a.normal.cross(b.normal).squaredNorm();
}

}  // namespace

bool one_sided(const LocalSurface& surface, const FitOptions& options) {
  return surface.order < options.order || surface.slope_leverage > kOneSidedSlope;
}

std::optional<LocalSurface> fit_aware(const Support& support, const Eigen::Vector3f& point,
                                      Found found, const FitOptions& options, double widest,
                                      double noise) {
  std::vector<LocalSurface> all;
  Agreement heights, normals;
  bool heights_agree = true, normals_agree = true;
  std::size_t before = 0;
  for (const double scale : kScales) {
    if (scale > widest * 1.001 || !(heights_agree || normals_agree)) break;
    const double radius2 = std::pow(scale * options.radius, 2);
    const auto end = std::partition_point(found.begin(), found.end(), [&](const Neighbour& n) {
      return static_cast<double>(n.distance2) <= radius2;
    });
    const auto count = static_cast<std::size_t>(end - found.begin());
    if (count == before) continue;
    before = count;
    const auto surface =
        fit_surface(support, point, found.first(count),
                    {options.order, scale * options.radius, scale * options.gaussian, false});
    if (!surface || surface->order < options.order) continue;
    all.push_back(*surface);
    heights_agree = heights_agree && heights.add(all, height_variance, noise, height_gap2);
    normals_agree = normals_agree && normals.add(all, normal_variance, noise, normal_gap2);
  }
  if (all.empty()) return fit_surface(support, point, found, options);
  LocalSurface chosen = all[heights.best()];
  chosen.normal = all[normals.best()].normal;
  return chosen;
}

Eigen::Vector3d step_along_ray(const LocalSurface& surface, const Eigen::Vector3d& to_sensor,
                               double noise) {
  const double facing = surface.normal.dot(to_sensor.normalized());
  const double height = surface.normal.dot(surface.step);
  if (!(std::abs(height) <= kOutlier * noise * std::abs(facing))) return surface.step;
  // Where the ray meets the surface is known to σ² variance / cos², where the point was to σ².
  const double trust = 1.0 / (1.0 + surface.variance / (facing * facing));
  const Eigen::Vector3d meeting = height / facing * to_sensor.normalized();
  return surface.step + trust * (meeting - surface.step);
}

}  // namespace velum::mls
