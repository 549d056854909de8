// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "shapes/plane_votes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace velum::shapes {
namespace {

constexpr std::size_t kFewest = 12;  // points that make a patch
constexpr double kLongest = 36.0;    // ratio of the mean squares along a patch: six times as long
constexpr double kMinAngle = 0.01;   // [rad], least width of a kernel
constexpr std::size_t kMostPatches = 3000;  // voters; every one looks at every other

}  // namespace

PlaneVotes::PlaneVotes(const Field& field, const Search& search, Context& context)
    : field_(field), epsilon_(search.epsilon), angle_(search.angle) {
  if (field.positions.cols() == 0) return;
  std::vector<std::int32_t> points(static_cast<std::size_t>(field.positions.cols()));
  std::iota(points.begin(), points.end(), 0);
  const Eigen::Vector3d low = field.positions.rowwise().minCoeff().cast<double>();
  const Eigen::Vector3d high = field.positions.rowwise().maxCoeff().cast<double>();
  const double side = (high - low).maxCoeff();
  split(points, 0, points.size(), {low, low + Eigen::Vector3d::Constant(side)}, context);
  std::stable_sort(patches_.begin(), patches_.end(),
                   [](const Patch& a, const Patch& b) { return a.votes > b.votes; });
  if (patches_.size() > kMostPatches) patches_.resize(kMostPatches);
}

void PlaneVotes::split(std::vector<std::int32_t>& points, std::size_t begin, std::size_t end,
                       const Eigen::AlignedBox3d& box, Context& context) {
  context.check();
  if (end - begin < kFewest || !(box.sizes().x() > epsilon_)) return;
  Patch patch;
  patch.moments = geometry::PointMoments(box.center());
  for (std::size_t i = begin; i < end; ++i)
    patch.moments.add(field_.positions.col(points[i]).cast<double>());
  patch.fit = patch.moments.plane();
  const auto& spread = patch.fit.spread;
  const bool flat = patch.fit.rms() <= 0.5 * epsilon_ && spread[2] <= kLongest * spread[1];
  if (flat && spread[1] > 0.0) {
    patch.votes = static_cast<double>(end - begin);
    // Standard error of a fitted normal: scatter over extent, less by the root of the count.
    patch.angle = std::max(kMinAngle, std::sqrt(spread[0] / spread[1] / patch.votes));
    patch.points.assign(points.begin() + static_cast<std::ptrdiff_t>(begin),
                        points.begin() + static_cast<std::ptrdiff_t>(end));
    patches_.push_back(std::move(patch));
    return;
  }
  const Eigen::Vector3d centre = box.center();
  const auto child_of = [&](std::int32_t p) {
    int child = 0;
    for (int axis = 0; axis < 3; ++axis)
      child |= static_cast<int>(static_cast<double>(field_.positions(axis, p)) >= centre[axis])
               << axis;
    return child;
  };
  std::size_t from = begin;
  for (int child = 0; child < 8; ++child) {
    const auto to = std::stable_partition(points.begin() + static_cast<std::ptrdiff_t>(from),
                                          points.begin() + static_cast<std::ptrdiff_t>(end),
                                          [&](std::int32_t p) { return child_of(p) == child; });
    const auto until = static_cast<std::size_t>(to - points.begin());
    Eigen::AlignedBox3d part(box.min(), centre);
    for (int axis = 0; axis < 3; ++axis)
      if ((child >> axis & 1) != 0) {
        part.min()[axis] = centre[axis];
        part.max()[axis] = box.max()[axis];
      }
    split(points, from, until, part, context);
    from = until;
  }
}

// Kernel of the accumulator between two votes: how far the planes differ in angle and at each
// other's patch, in units of their uncertainty.
double PlaneVotes::agreement(const Patch& a, const Patch& b) const {
  const double cosine = std::min(1.0, std::abs(a.fit.normal.dot(b.fit.normal)));
  const double width = a.angle + b.angle;
  if (1.0 - cosine > 4.5 * width * width) return 0.0;  // more than three widths, by the series
  const double turn = std::acos(cosine) / width;
  const double apart = (a.fit.centroid - b.fit.centroid).norm();
  const double near = 0.5 * epsilon_ + apart * std::min(a.angle, width);
  const double step =
      std::max(std::abs(a.fit.distance(b.fit.centroid)), std::abs(b.fit.distance(a.fit.centroid))) /
      near;
  return step > 3.0 ? 0.0 : std::exp(-0.5 * (turn * turn + step * step));
}

std::optional<Shape> PlaneVotes::peak(Context& context) const {
  std::vector<double> density(patches_.size(), 0.0);
  parallel_for(context, static_cast<Index>(patches_.size()), 32, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const Patch& own = patches_[static_cast<std::size_t>(i)];
      if (own.votes <= 0.0) continue;
      double sum = 0.0;
      for (const Patch& other : patches_)
        if (other.votes > 0.0) sum += other.votes * agreement(own, other);
      density[static_cast<std::size_t>(i)] = sum;
    }
  });
  const auto top = std::max_element(density.begin(), density.end());
  if (top == density.end() || *top <= 0.0) return std::nullopt;
  const Patch& best = patches_[static_cast<std::size_t>(top - density.begin())];
  geometry::PointMoments voters(best.fit.centroid);
  for (const Patch& other : patches_)
    if (other.votes > 0.0 && agreement(best, other) > 0.3) voters.add(other.moments);
  const geometry::PlaneFit fit = voters.plane();
  return Shape{.kind = Kind::plane, .point = fit.centroid, .axis = fit.normal};
}

void PlaneVotes::withdraw(const Eigen::VectorXi& labels) {
  for (Patch& patch : patches_) {
    const auto free = std::count_if(patch.points.begin(), patch.points.end(),
                                    [&](std::int32_t p) { return labels[p] < 0; });
    // What is left of a patch after its plane was taken is that plane's rim.
    const bool rest = 2 * static_cast<std::size_t>(free) < patch.points.size();
    patch.votes = rest ? 0.0 : std::min(patch.votes, static_cast<double>(free));
  }
}

void PlaneVotes::refuse(const Shape& plane) {
  for (Patch& patch : patches_)
    if (std::abs(plane.distance(patch.fit.centroid)) <= epsilon_ &&
        std::abs(patch.fit.normal.dot(plane.axis)) >= std::cos(angle_))
      patch.votes = 0.0;
}

}  // namespace velum::shapes
