// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "geometry/eigen3.hpp"
#include "geometry/moments.hpp"
#include "geometry/normals.hpp"

namespace velum::geometry {
namespace {

using Found = std::span<const Neighbour>;

// Balls in which the noise is looked for, in points.
constexpr std::array<std::size_t, 4> kSizes = {32, 64, 128, 256};
constexpr Index kSamples = 512;
constexpr int kTerms = 6;
// A ball cuts the noise off above and below. The fit takes what lies within this share of its
// radius from the axis, where four standard deviations of noise remain, and asks for a ball wide
// enough.
constexpr double kInner = 0.6;
constexpr double kWide = 4.0;

// Least squares fit of z = a + bx + cy + dx² + exy + fy².
class Quadric {
 public:
  void add(double x, double y, double z) {
    const Vector row{1.0, x, y, x * x, x * y, y * y};
    normal_.noalias() += row * row.transpose();
    right_ += z * row;
    heights_ += z * z;
    ++count_;
  }
  [[nodiscard]] bool determined() const { return count_ >= kTerms + 3; }
  // Root mean square, with the freedoms taken by the fit accounted for.
  [[nodiscard]] double residual() const {
    const double squares = heights_ - right_.dot(normal_.ldlt().solve(right_));
    return std::sqrt(std::max(squares, 0.0) / static_cast<double>(count_ - kTerms));
  }

 private:
  using Vector = Eigen::Matrix<double, kTerms, 1>;
  Eigen::Matrix<double, kTerms, kTerms> normal_ = Eigen::Matrix<double, kTerms, kTerms>::Zero();
  Vector right_ = Vector::Zero();
  double heights_ = 0.0;
  int count_ = 0;
};

// Residual [m] of the surface's best quadric within a ball; nothing where too few points are left.
std::optional<double> residual_in(const ConstPoints& positions, Index query, Found found) {
  const Eigen::Vector3f centre = positions.col(query);
  NeighbourMoments moments;
  for (const Neighbour& n : found) moments.add(positions.col(n.index) - centre);
  const Eigen3 axes = eigen3(moments.covariance());
  const double scale = std::sqrt(static_cast<double>(found.back().distance2));
  if (!(scale > 0.0)) return std::nullopt;
  Quadric quadric;
  for (const Neighbour& n : found) {
    const Eigen::Vector3d d =
        axes.vectors.transpose() * (positions.col(n.index) - centre).cast<double>() / scale;
    if (d.tail<2>().squaredNorm() <= kInner * kInner) quadric.add(d.y(), d.z(), d.x());
  }
  if (!quadric.determined()) return std::nullopt;
  return scale * quadric.residual();
}

// The residual in the smallest ball that is wide enough for it; the largest ball's where none is.
double noise_at(const ConstPoints& positions, Index query, Found found) {
  double noise = 0.0;
  for (const std::size_t size : kSizes) {
    const Found ball = found.first(std::min(size, found.size()));
    if (const auto residual = residual_in(positions, query, ball)) {
      noise = *residual;
      if (std::sqrt(static_cast<double>(ball.back().distance2)) >= kWide * noise) break;
    }
    if (ball.size() == found.size()) break;
  }
  return noise;
}

}  // namespace

double estimate_noise(const Cloud& cloud, Context& context) {
  const ConstPoints positions = cloud.positions();
  if (cloud.empty()) return 0.0;
  const Index samples = std::min(cloud.size(), kSamples);
  std::vector<Index> chosen(static_cast<std::size_t>(samples));
  Points queries(3, samples);
  for (Index i = 0; i < samples; ++i) {
    chosen[static_cast<std::size_t>(i)] = i * cloud.size() / samples;
    queries.col(i) = positions.col(i * cloud.size() / samples);
  }
  std::vector<double> residuals(chosen.size());
  const ConstPoints view(queries.data(), 3, samples);
  cloud.neighbours().each_nearest(view, static_cast<Index>(kSizes.back()), context,
                                  [&](Index i, Found found) {
                                    const auto slot = static_cast<std::size_t>(i);
                                    residuals[slot] = noise_at(positions, chosen[slot], found);
                                  });
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return *middle;
}

}  // namespace velum::geometry
