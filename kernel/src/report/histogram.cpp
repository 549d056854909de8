// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "report/histogram.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace velum::report {
namespace {

/// Share of the numbers on each side that may be left out as tails.
constexpr double kTail = 0.005;
/// Tails are left out when the rest needs less than this share of the range.
constexpr double kWorthIt = 0.5;
constexpr double kDegrees = 180.0 / std::numbers::pi;

struct Extent {
  double lo = 0.0;
  double hi = 0.0;
};

/// The bin of x among `count` equal ones. By halves, since the difference of two finite numbers may
/// be infinite.
std::size_t bin_of(double x, const Extent& extent, std::size_t count) {
  const double half = 0.5 * extent.hi - 0.5 * extent.lo;
  const double share = half > 0.0 ? (0.5 * x - 0.5 * extent.lo) / half : 0.0;
  return std::min(static_cast<std::size_t>(share * static_cast<double>(count)), count - 1);
}

/// Of the finite numbers; nothing when there are none.
std::optional<Extent> extent_of(const std::vector<double>& numbers) {
  std::optional<Extent> extent;
  for (const double x : numbers) {
    if (!std::isfinite(x)) continue;
    if (!extent) extent = {x, x};
    extent->lo = std::min(extent->lo, x);
    extent->hi = std::max(extent->hi, x);
  }
  return extent;
}

/// The range without its tails, to a fine step.
Extent without_tails(const std::vector<double>& numbers, const Extent& whole) {
  constexpr std::size_t kFine = 4096;
  std::vector<std::size_t> counts(kFine, 0);
  std::size_t total = 0;
  for (const double x : numbers) {
    if (!std::isfinite(x)) continue;
    ++counts[bin_of(x, whole, kFine)];
    ++total;
  }
  const auto most = static_cast<std::size_t>(kTail * static_cast<double>(total));
  std::size_t first = 0;
  for (std::size_t left_out = counts[0]; left_out <= most; left_out += counts[++first]) {
  }
  std::size_t last = kFine - 1;
  for (std::size_t left_out = counts[last]; left_out <= most; left_out += counts[--last]) {
  }
  if (last < first) return whole;
  const double step = (whole.hi - whole.lo) / static_cast<double>(kFine);
  return {whole.lo + static_cast<double>(first) * step,
          whole.lo + static_cast<double>(last + 1) * step};
}

}  // namespace

Histogram histogram(std::string name, std::string unit, const std::vector<double>& numbers,
                    double lo, double hi) {
  Histogram made{.name = std::move(name),
                 .unit = std::move(unit),
                 .better = "",
                 .lo = lo,
                 .hi = hi,
                 .counts = std::vector<std::uint64_t>(kBins, 0)};
  for (const double x : numbers) {
    if (!std::isfinite(x)) continue;
    if (x < lo) {
      ++made.below;
    } else if (x > hi) {
      ++made.above;
    } else {
      ++made.counts[bin_of(x, {lo, hi}, kBins)];
    }
  }
  return made;
}

Histogram histogram(std::string name, std::string unit, const std::vector<double>& numbers) {
  const auto whole = extent_of(numbers);
  if (!whole) return histogram(std::move(name), std::move(unit), numbers, 0.0, 0.0);
  Extent range = *whole;
  if (std::isfinite(whole->hi - whole->lo) && whole->hi > whole->lo) {
    const Extent inner = without_tails(numbers, *whole);
    if (inner.hi - inner.lo < kWorthIt * (whole->hi - whole->lo)) range = inner;
  }
  return histogram(std::move(name), std::move(unit), numbers, range.lo, range.hi);
}

std::vector<Histogram> triangle_histograms(const Mesh& mesh) {
  const auto positions = mesh.positions();
  const auto triangles = mesh.triangles();
  std::vector<double> angles;
  std::vector<double> ratios;
  angles.reserve(static_cast<std::size_t>(3 * triangles.cols()));
  ratios.reserve(static_cast<std::size_t>(triangles.cols()));
  for (Index t = 0; t < triangles.cols(); ++t) {
    std::array<Eigen::Vector3d, 3> corner;
    for (std::size_t i = 0; i < 3; ++i)
      corner[i] = positions.col(triangles(static_cast<Index>(i), t)).cast<double>();
    const Eigen::Vector3d edges((corner[1] - corner[0]).norm(), (corner[2] - corner[1]).norm(),
                                (corner[0] - corner[2]).norm());
    const double area = 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
    if (area <= 1e-12 * edges.squaredNorm()) continue;
    ratios.push_back(edges.maxCoeff() / edges.minCoeff());
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d a = corner[(i + 1) % 3] - corner[i];
      const Eigen::Vector3d b = corner[(i + 2) % 3] - corner[i];
      angles.push_back(std::atan2(a.cross(b).norm(), a.dot(b)) * kDegrees);
    }
  }
  return {histogram("angle", "deg", angles, 0.0, 180.0), histogram("edge ratio", "", ratios)};
}

Histogram distances(std::string name, const Cloud& cloud, const Cloud& target, Context& context) {
  // About one origin, which the index does not have to know of.
  const Eigen::Vector3f shift = (cloud.origin() - target.origin()).cast<float>();
  const Index step = (cloud.size() + kMostDistances - 1) / kMostDistances;
  Points queries(3, cloud.empty() ? 0 : (cloud.size() + step - 1) / step);
  for (Index i = 0; i < queries.cols(); ++i)
    queries.col(i) = cloud.positions().col(i * step) + shift;
  std::vector<double> found(static_cast<std::size_t>(queries.cols()));
  target.neighbours().each_nearest(ConstPoints(queries.data(), 3, queries.cols()), 1, context,
                                   [&](Index i, std::span<const Neighbour> nearest) {
                                     if (!nearest.empty())
                                       found[static_cast<std::size_t>(i)] = std::sqrt(
                                           static_cast<double>(nearest.front().distance2));
                                   });
  Histogram made = histogram(std::move(name), "m", found);
  made.better = "lower";
  return made;
}

}  // namespace velum::report
