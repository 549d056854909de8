// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "gaps.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/viewpoint.hpp"
#include "patch.hpp"

namespace velum::mixed {
namespace {

// Neighbours looked at; of more, an even choice.
constexpr std::size_t kLooked = 96;
// How far around a point is looked: so many spots and steps between beams, or the least number of
// steps in which a quarter has enough neighbours; at most half a radian.
constexpr double kSpots = 1.2;
constexpr double kSteps = 2.0;
constexpr double kLeastSteps = 3.5;
constexpr double kFarthest = 0.5;

// What one sensor saw, by direction.
struct View {
  std::vector<std::int32_t> points;
  Points directions;
  Eigen::VectorXd ranges;
  double step = 0.0;  // angle between neighbouring beams [rad]
};

std::vector<View> views_of(const Cloud& cloud) {
  const geometry::Viewpoints viewpoints(cloud);
  std::vector<View> views(std::max<std::size_t>(cloud.sensors().size(), 1));
  std::vector<Eigen::Vector3d> rays(static_cast<std::size_t>(cloud.size()));
  for (Index i = 0; i < cloud.size(); ++i) {
    Eigen::Vector3d& ray = rays[static_cast<std::size_t>(i)];
    ray = -viewpoints.from(i);
    // A point at the sensor itself has no direction.
    if (ray.norm() > 1e-9)
      views[cloud.sensor_of(i).value_or(0)].points.push_back(static_cast<std::int32_t>(i));
  }
  for (View& view : views) {
    const auto n = static_cast<Index>(view.points.size());
    view.directions.resize(3, n);
    view.ranges.resize(n);
    for (Index i = 0; i < n; ++i) {
      const auto point = static_cast<std::size_t>(view.points[static_cast<std::size_t>(i)]);
      view.ranges[i] = rays[point].norm();
      view.directions.col(i) = (rays[point] / view.ranges[i]).cast<float>();
    }
  }
  return views;
}

// Median angle to the eighth neighbour, which is a diagonal of the raster.
double step_of(const View& view, const Neighbours& index) {
  constexpr Index kSamples = 2000;
  const Index n = view.ranges.size();
  const Index samples = std::min(n, kSamples);
  std::vector<Neighbour> found;
  std::vector<double> steps;
  for (Index s = 0; s < samples; ++s) {
    index.nearest(view.directions.col(s * n / samples), 9, found);
    steps.push_back(std::sqrt(static_cast<double>(found.back().distance2) / 2.0));
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

// Judges the points of one view.
class Judge {
 public:
  Judge(const View& view, const Neighbours& index, const Beam& beam)
      : view_(view), index_(index), beam_(beam), gap_(view.points.size(), 0) {}

  // First what is on a surface by itself, or has nothing behind it; then what is beside it.
  std::vector<std::uint8_t> run(Context& context) {
    std::vector<Index> all(view_.points.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Index>(i);
    pass(all, context,
         [](const Patch& patch) { return patch.something_behind() && !patch.on_surface(); });
    std::vector<Index> left;
    for (const Index i : all)
      if (gap_[static_cast<std::size_t>(i)] != 0) left.push_back(i);
    pass(left, context,
         [](const Patch& patch) { return !patch.beside_surface() && !patch.on_strip(); });
    return std::move(gap_);
  }

 private:
  template <class Verdict>
  void pass(const std::vector<Index>& points, Context& context, const Verdict& verdict) {
    std::vector<std::uint8_t> next = gap_;
    parallel_for(context, static_cast<Index>(points.size()), 256, [&](Index begin, Index end) {
      context.check();
      std::vector<Neighbour> found;
      for (Index k = begin; k < end; ++k) {
        const Index i = points[static_cast<std::size_t>(k)];
        next[static_cast<std::size_t>(i)] = verdict(patch_of(i, found)) ? 1 : 0;
      }
    });
    gap_ = std::move(next);
  }

  [[nodiscard]] Patch patch_of(Index i, std::vector<Neighbour>& found) const {
    const double range = view_.ranges[i];
    const double spot = beam_.spot(range) / range;
    const double reach = std::max(kSpots * spot + kSteps * view_.step, kLeastSteps * view_.step);
    index_.within(view_.directions.col(i), std::min(reach, kFarthest), found);
    Patch patch(range, beam_.noise, 0.5 * (spot + view_.step));
    const Eigen::Vector3d ray = view_.directions.col(i).cast<double>().normalized();
    const Eigen::Vector3d side = ray.unitOrthogonal();
    const Eigen::Vector3d other = ray.cross(side);
    const std::size_t stride = (found.size() + kLooked - 1) / kLooked;
    for (std::size_t k = 0; k < found.size(); k += stride) {
      const Index j = found[k].index;
      if (j == i) continue;
      const Eigen::Vector3d direction = view_.directions.col(j).cast<double>();
      const double along = direction.dot(ray);
      patch.add({Eigen::Vector2d(direction.dot(side), direction.dot(other)) / along,
                 1.0 / (view_.ranges[j] * along), gap_[static_cast<std::size_t>(j)] == 0});
    }
    return patch;
  }

  const View& view_;
  const Neighbours& index_;
  Beam beam_;
  std::vector<std::uint8_t> gap_;
};

}  // namespace

std::vector<std::uint8_t> in_gaps(const Cloud& cloud, const Beam& beam, Context& context) {
  std::vector<std::uint8_t> gaps(static_cast<std::size_t>(cloud.size()), 0);
  for (View& view : views_of(cloud)) {
    if (view.points.size() < 3) continue;
    const Neighbours index(ConstPoints(view.directions.data(), 3, view.directions.cols()));
    view.step = step_of(view, index);
    const std::vector<std::uint8_t> judged = Judge(view, index, beam).run(context);
    for (std::size_t i = 0; i < judged.size(); ++i)
      gaps[static_cast<std::size_t>(view.points[i])] = judged[i];
  }
  return gaps;
}

}  // namespace velum::mixed
